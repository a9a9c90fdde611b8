#include <array>
#include <cmath>
#include <string>

#include "scenes/builtin/placing.h"
#include "scenes/builtin/scenes.h"

namespace umbrameter::builtin {
namespace {

// A high roof over low plates. The roof's front edge casts its shadow along z = edge_shadow on the floor, and each
// plate stands where that edge halves the plate's own shadow. There a filter sees half roof, a metres along the light
// above the floor, and half plate, b metres above it, and Chebyshev's bound lets (a − b)²/(2(a² + b²)) of the light
// through to a floor that gets none (Donnelly and Lauritzen, Variance Shadow Maps, 2006, section 4): 46 % under the
// lowest plate, 9 % under the highest.
constexpr double roof_underside = 3.2;
constexpr double roof_thickness = 0.16;
constexpr double roof_half_length = 3.9;
constexpr double roof_depth = 2.8;
constexpr double edge_shadow = 0.4;
constexpr std::array<double, 5> gaps{0.1, 0.2, 0.4, 0.8, 1.6};  // from the floor to the plate's underside
constexpr double plate_thickness = 0.04;
constexpr double plate_half_side = 0.42;
constexpr double plate_pitch = 1.45;
// For each metre of height a shadow falls this far to the right and to the back.
constexpr double rightwards = 0.65;
constexpr double backwards = 0.35;

}  // namespace

Scene make_two_occluders() {
  Scene scene;
  scene.name = "two-occluders";
  const std::uint32_t stone = add_material(scene, "pale stone", vec3(0.64f, 0.60f, 0.52f));
  const std::uint32_t plaster = add_material(scene, "plaster", vec3(0.55f, 0.51f, 0.45f));
  const std::uint32_t wood = add_material(scene, "cedar", vec3(0.43f, 0.20f, 0.10f));
  const std::uint32_t ochre = add_material(scene, "ochre plaster", vec3(0.66f, 0.47f, 0.28f));
  const std::uint32_t steel = add_material(scene, "blued steel", vec3(0.07f, 0.085f, 0.10f));
  const std::uint32_t earth = add_material(scene, "gravel", vec3(0.24f, 0.22f, 0.19f));

  place_once(scene, to_mesh("receiver", box(dvec3(-7.8, -0.2, -4.5), dvec3(5.2, 0.0, 3.4)), stone));
  place_once(scene, to_mesh("gravel", box(dvec3(-9.0, -0.5, -9.0), dvec3(9.0, -0.1, 6.0)), earth));

  // Behind it all, beyond the roof's shadow.
  place_once(scene, to_mesh("wall", box(dvec3(-7.4, -0.15, -4.05), dvec3(5.0, 2.2, -3.75)), ochre));
  place_once(scene,
             to_mesh("coping", chamfered_box(dvec3(-7.46, 2.19, -4.11), dvec3(5.06, 2.27, -3.69), 0.01), stone, 20.0));

  // The light passes the lower front edge last.
  const double front = edge_shadow + backwards * roof_underside;
  const double middle = -rightwards * roof_underside;
  place_once(scene, to_mesh("roof",
                            box(dvec3(middle - roof_half_length, roof_underside, front - roof_depth),
                                dvec3(middle + roof_half_length, roof_underside + roof_thickness, front)),
                            plaster));
  const std::array<dvec2, 4> shaft{dvec2(0, -0.01), dvec2(0.055, -0.01), dvec2(0.055, roof_underside + 0.02),
                                   dvec2(0, roof_underside + 0.02)};
  const std::uint32_t column = add_mesh(scene, to_mesh("column", lathe(shaft, 32), steel));
  for (const double x : {-roof_half_length + 0.5, 0.0, roof_half_length - 0.5}) {
    place(scene, column, "column", moved(dvec3(middle + x, 0, front - roof_depth + 0.5)));
  }

  const std::uint32_t plate = add_mesh(scene, to_mesh("plate",
                                                      box(dvec3(-plate_half_side, 0, -plate_half_side),
                                                          dvec3(plate_half_side, plate_thickness, plate_half_side)),
                                                      wood));
  for (std::size_t i = 0; i < gaps.size(); ++i) {
    const double gap = gaps[i];
    const dvec3 foot{plate_pitch * (static_cast<double>(i) - 2.0) - 0.5 * rightwards * gap, 0.0,
                     edge_shadow + backwards * gap};
    const std::string name = std::to_string(std::lround(100.0 * gap)) + " cm";
    place(scene, plate, "plate " + name, moved(foot + dvec3(0, gap, 0)));
    const std::array<dvec2, 6> stem{dvec2(0, -0.006),   dvec2(0.10, -0.006),      dvec2(0.10, 0.012),
                                    dvec2(0.018, 0.02), dvec2(0.018, gap + 0.01), dvec2(0, gap + 0.01)};
    place_once(scene, to_mesh("stem " + name, lathe(stem, 32), steel), moved(foot));
  }

  add_camera(scene, "overview", looking(dvec3(2.4, 2.65, 7.2), dvec3(-0.9, 1.0, -0.2)), 44.5);
  add_camera(scene, "edge", looking(dvec3(1.9, 1.7, 3.4), dvec3(0.95, 0.22, 0.45)), 36.0);
  add_camera(scene, "low-plates", looking(dvec3(-3.0, 0.75, 2.3), dvec3(-2.15, 0.05, 0.45)), 40.0);
  const dvec3 to_sun(-rightwards, 1.0, backwards);
  add_sun(scene, "sun", dvec3(0.0, 1.0, -0.5), to_sun, 12.0, 3.0);
  // As the sun, from a point: its maps are perspective ones.
  add_spot(scene, "spot", looking(dvec3(0.5, 0.0, edge_shadow) + 7.0 * to_sun, dvec3(0.5, 0.0, edge_shadow)), 20.0,
           27.0, 9.0);
  return scene;
}

}  // namespace umbrameter::builtin
