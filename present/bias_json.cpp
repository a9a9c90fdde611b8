#include <nlohmann/json.hpp>

#include "present/bias_formulas.h"
#include "present/plateau_text.h"
#include "present/summary.h"
#include "reports/files/value_json.h"

namespace umbrameter {
namespace {

using Json = nlohmann::ordered_json;

Json cell_json(const BiasCurves& curves, const std::optional<BiasCell>& cell, const BiasCurve& curve) {
  if (!cell) return nullptr;
  return {{"constant_bias", to_json(in_units(curves, curve, *cell))},
          {"slope_bias_texels", cell->slope},
          {"mae", cell->mae},
          {"acne", cell->acne},
          {"false_occlusion", cell->false_occlusion},
          {"peter_panning", cell->peter_panning},
          {"leak", cell->leak}};
}

Json curve_json(const BiasCurves& curves, const BiasCurve& curve) {
  const BiasOptima& optima = curve.optima;
  const BiasLine& line = flattest(optima);
  Json object = {{"at", row_json(curves.others, curve.others)},
                 {"mean_texel_m", optima.mean_texel},
                 {"least_error", cell_json(curves, least_error(optima), curve)}};
  if (curve.plateau) {
    add_plateau(object, *curve.plateau, curve.evidence, curve.withheld,
                [&](const BiasCell& cell) { return cell_json(curves, cell, curve); });
  }
  if (curves.varies_constant) {
    object["acne_at_most_0.1_percent"] = cell_json(curves, line.little_acne, curve);
    object["acne_free"] = cell_json(curves, line.acne_free, curve);
  }
  object["acne_free_least_error"] = cell_json(curves, best_without_acne(optima), curve);
  object["knee"] = cell_json(curves, knee(optima.front), curve);
  object["front_cells"] = optima.front.by_acne.size();
  if (optima.front.thinned) object["front_is_thinned"] = true;
  return object;
}

}  // namespace

nlohmann::ordered_json to_json(const BiasCurves& curves) {
  Json object = {{"combinations", curves.combinations}, {"biases", Json::array()}};
  for (const BiasCurve& curve : curves.curves) object["biases"].push_back(curve_json(curves, curve));
  if (!curves.formulas.empty()) object["formulas"] = formulas_json(curves);
  return object;
}

}  // namespace umbrameter
