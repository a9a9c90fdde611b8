#include <nlohmann/json.hpp>

#include "app/bias_report.h"

namespace umbrameter {
namespace {

using Json = nlohmann::ordered_json;

Json setting_json(const std::vector<Column>& columns, const std::vector<Value>& values) {
  Json object = Json::object();
  for (std::size_t i = 0; i < columns.size() && i < values.size(); ++i) {
    object[columns[i].name] = std::visit([](const auto& value) { return Json(value); }, values[i]);
  }
  return object;
}

Json cell_json(const std::optional<BiasCell>& cell, const BiasCurve& curve) {
  if (!cell) return nullptr;
  const double texel = curve.reading.mean_texel;
  const auto share_of = [&](double whole) { return whole > 0.0 ? Json(cell->constant / whole) : Json(nullptr); };
  return {{"constant_bias",
           {{"m", cell->constant}, {"texels", share_of(texel)}, {"normalised_depth", share_of(curve.depth_range)}}},
          {"slope_bias_texels", cell->slope},
          {"mae", cell->mae},
          {"acne", cell->acne},
          {"false_occlusion", cell->false_occlusion},
          {"peter_panning", cell->peter_panning},
          {"leak", cell->leak}};
}

Json curve_json(const BiasCurves& curves, const BiasCurve& curve) {
  const BiasReading& reading = curve.reading;
  const BiasLine& line = flattest(reading);
  Json object = {{"at", setting_json(curves.others, curve.others)},
                 {"mean_texel_m", reading.mean_texel},
                 {"least_error", cell_json(least_error(reading), curve)}};
  if (curves.varies_constant) {
    object["acne_at_most_0.1_percent"] = cell_json(line.little_acne, curve);
    object["acne_free"] = cell_json(line.acne_free, curve);
  }
  object["acne_free_least_error"] = cell_json(best_without_acne(reading), curve);
  object["knee"] = cell_json(knee(reading.front), curve);
  object["front_cells"] = reading.front.by_acne.size();
  if (reading.front.thinned) object["front_is_thinned"] = true;
  return object;
}

Json fitted_json(const Fitted& fitted) {
  return {{"value", fitted.value},
          {"standard_error", fitted.standard_error ? Json(*fitted.standard_error) : Json(nullptr)}};
}

Json law_json(const BiasCurves& curves, const CurveLaw& law) {
  Json object = {{"bias", law.bias}, {"at", setting_json(curves.of_a_law, law.others)}, {"left_out", law.left_out}};
  object["points"] = law.law ? law.law->points : 0;
  if (!law.law) return object;
  object["c0_m"] = fitted_json(law.law->constant);
  object["c1_tangent_texels"] = fitted_json(law.law->per_texel);
  if (law.law->tangent) object["tangent"] = fitted_json(*law.law->tangent);
  if (law.law->slope_factor) object["c1_texels"] = fitted_json(*law.law->slope_factor);
  object["residual_m"] = law.law->residual;
  object["residual_texels"] = law.law->residual_texels;
  return object;
}

}  // namespace

nlohmann::ordered_json to_json(const BiasCurves& curves) {
  Json object = {{"combinations", curves.combinations}, {"biases", Json::array()}, {"laws", Json::array()}};
  for (const BiasCurve& curve : curves.curves) object["biases"].push_back(curve_json(curves, curve));
  for (const CurveLaw& law : curves.laws) object["laws"].push_back(law_json(curves, law));
  return object;
}

}  // namespace umbrameter
