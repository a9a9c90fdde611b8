#include "scenes/scene_params.h"

#include <array>
#include <string_view>
#include <utility>

#include "core/error.h"
#include "core/lists.h"

namespace umbrameter {
namespace {

constexpr std::array<std::string_view, 3> blend_mode_names{"opaque", "leave-out", "mask"};

constexpr std::array<std::pair<std::string_view, double>, 8> named_units{{{"mm", 0.001},
                                                                          {"cm", 0.01},
                                                                          {"m", 1.0},
                                                                          {"km", 1000.0},
                                                                          {"inch", 0.0254},
                                                                          {"in", 0.0254},
                                                                          {"foot", 0.3048},
                                                                          {"ft", 0.3048}}};

constexpr double shortest_unit = 1e-12;  // metres
constexpr double longest_unit = 1e12;    // metres

}  // namespace

Parameters describe(SceneParams& params) {
  return Description("scene")
      .field("unit", params.unit,
             {.unit = {}, .meaning = "unit of lengths: mm, cm, m, km, inch, foot, or its length in m", .basic = true})
      .choice("blend", params.blend, blend_mode_names,
              {.unit = {}, .meaning = "alpha-blended and transmissive surfaces; mask: holes where alpha is below 0.5"})
      .field("ground", params.ground, {.unit = {}, .meaning = "add a floor below the scene, 5 times its diagonal wide"})
      .take();
}

double metres_per_unit(const std::string& unit) {
  for (const auto& [name, metres] : named_units) {
    if (unit == name) return metres;
  }
  const std::optional<double> metres = parsed<double>(unit);
  if (metres && *metres >= shortest_unit && *metres <= longest_unit) return *metres;
  throw Error(ExitCode::usage, "--scene.unit " + unit.substr(0, 60),
              metres ? "the number is not between 1e-12 and 1e12" : "there is no such unit",
              "give mm, cm, m, km, inch, foot, or the length of the unit in metres, such as 0.01");
}

}  // namespace umbrameter
