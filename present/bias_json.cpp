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

void add_law(Json& object, const BiasFit& law) {
  object["points"] = law.points;
  object["c0_m"] = fitted_json(law.constant);
  object["c1_tangent_texels"] = fitted_json(law.per_texel);
  object["residual_m"] = law.residual;
  object["residual_texels"] = law.residual_texels;
}

Json law_json(const BiasCurves& curves, const CurveLaw& law) {
  Json object = {{"bias", law_names[static_cast<std::size_t>(law.of)]},
                 {"at", row_json(curves.of_a_law, law.others)},
                 {"left_out", law.left_out}};
  if (law.law) {
    object["slope_bias_texels"] = law.law->first_slope;
    add_law(object, *law.law);
  }
  if (law.over_slopes) {
    Json over = Json::object();
    add_law(over, *law.over_slopes);
    over["from_slope_bias_texels"] = law.over_slopes->first_slope;
    if (law.over_slopes->tangent) over["tangent"] = fitted_json(*law.over_slopes->tangent);
    if (law.over_slopes->slope_factor) over["c1_texels"] = fitted_json(*law.over_slopes->slope_factor);
    object["over_slope_biases"] = over;
  }
  return object;
}

}  // namespace

nlohmann::ordered_json fitted_json(const Fitted& fitted) {
  return {{"value", fitted.value},
          {"standard_error", fitted.standard_error ? Json(*fitted.standard_error) : Json(nullptr)}};
}

nlohmann::ordered_json to_json(const BiasCurves& curves) {
  Json object = {{"combinations", curves.combinations}, {"biases", Json::array()}, {"laws", Json::array()}};
  for (const BiasCurve& curve : curves.curves) object["biases"].push_back(curve_json(curves, curve));
  for (const CurveLaw& law : curves.laws) object["laws"].push_back(law_json(curves, law));
  if (!curves.formulas.empty()) object["formulas"] = formulas_json(curves);
  return object;
}

}  // namespace umbrameter
