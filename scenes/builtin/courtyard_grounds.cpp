#include <array>
#include <cmath>

#include "scenes/builtin/courtyard.h"
#include "scenes/builtin/parts.h"

namespace umbrameter::builtin {
namespace {

constexpr double slab = 0.7;
using Tints = std::array<std::uint32_t, 3>;

// Slabs of 70 cm with open joints, whose tops lie about y.
void pave(Scene& scene, const Tints& tints, std::uint32_t seed, const dvec3& corner, int columns, int rows,
          double width = slab) {
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const std::uint32_t number = hash(seed, row, column);
      const dvec3 at = corner + dvec3(width * (column + 0.5), chance(number, 1, -0.0015, 0.0015), slab * (row + 0.5));
      place(scene, tints[static_cast<std::size_t>(chance(number, 2, 0.0, 2.999))], "paving slab",
            moved(at) * scaled(dvec3(width / slab, 1.0, 1.0)));
    }
  }
}

}  // namespace

void add_paving(Scene& scene, const Palette& palette) {
  place_once(scene, to_mesh("ground", box(dvec3(-12.0, -0.4, -10.0), dvec3(8.8, -0.03, 8.6)), palette.earth));
  const Shape stone = bevelled_slab(dvec3(-0.347, -0.09, -0.347), dvec3(0.347, 0.0, 0.347), 0.007);
  const Tints tints{add_mesh(scene, to_mesh("slab", stone, palette.limestone, 20.0)),
                    add_mesh(scene, to_mesh("pale slab", stone, palette.pale_stone, 20.0)),
                    add_mesh(scene, to_mesh("warm slab", stone, palette.warm_stone, 20.0))};
  pave(scene, tints, 1, dvec3(-7.0, 0.0, -5.5), 20, 20);
  pave(scene, tints, 2, dvec3(-7.0, arcade_floor, -9.1), 20, 5);
  pave(scene, tints, 3, dvec3(-10.98, terrace, -5.05), 6, 16, 0.66);
  place_once(scene, to_mesh("arcade bed", box(dvec3(-7.08, -0.06, -9.2), dvec3(7.3, 0.13, -5.6)), palette.limestone));
  place_once(scene, to_mesh("arcade kerb",
                            chamfered_box(dvec3(-7.1, -0.07, -5.62), dvec3(7.2, arcade_floor + 0.006, -5.46), 0.015),
                            palette.pale_stone, 20.0));
}

void add_fence(Scene& scene, const Palette& palette) {
  constexpr double x = 7.18;
  place_once(scene, to_mesh("plinth", box(dvec3(x - 0.19, -0.08, -5.7), dvec3(x + 0.19, 0.52, 8.3)), palette.plaster));
  place_once(scene,
             to_mesh("plinth coping", chamfered_box(dvec3(x - 0.24, 0.5, -5.72), dvec3(x + 0.24, 0.6, 8.34), 0.015),
                     palette.pale_stone, 20.0));
  Shape pier = chamfered_box(dvec3(-0.23, -0.07, -0.23), dvec3(0.23, 2.3, 0.23), 0.015);
  append(pier, chamfered_box(dvec3(-0.29, 2.28, -0.29), dvec3(0.29, 2.40, 0.29), 0.02));
  append(pier, finial(0.17), moved(dvec3(0, 2.4, 0)));
  const std::uint32_t piers = add_mesh(scene, to_mesh("fence pier", pier, palette.limestone, 30.0));
  Sheet panel;
  add_card(panel, dvec3(0, 0.75, 0), dvec3(0, 0, -1.0), dvec3(0, 0.75, 0));
  const std::uint32_t panels = add_mesh(scene, to_mesh("fence panel", panel, palette.fence));
  for (int i = 0; i < 5; ++i) {
    const double z = -3.2 + 2.4 * i;
    place(scene, piers, "fence pier", moved(dvec3(x, 0, z)));
    place(scene, panels, "fence panel", moved(dvec3(x, 0.58, z - 1.2)) * scaled(dvec3(1.0, 1.0, 0.99)));
  }
}

void add_terrace(Scene& scene, const Palette& palette) {
  constexpr double edge = -7.0;
  place_once(scene,
             to_mesh("terrace", box(dvec3(-11.2, -0.05, -5.2), dvec3(edge, terrace - 0.05, 6.2)), palette.plaster));
  Shape trim;
  append(trim, chamfered_box(dvec3(edge - 0.16, 1.21, -5.1), dvec3(edge + 0.11, terrace + 0.008, 0.5), 0.014));
  append(trim, chamfered_box(dvec3(edge - 0.16, 1.21, 3.7), dvec3(edge + 0.11, terrace + 0.008, 6.31), 0.014));
  append(trim, chamfered_box(dvec3(-11.1, 1.205, 6.04), dvec3(edge + 0.02, terrace + 0.012, 6.32), 0.014));
  append(trim, chamfered_box(dvec3(edge - 0.14, 1.2, 0.45), dvec3(edge + 0.05, terrace + 0.012, 3.75), 0.014));
  append(trim, chamfered_box(dvec3(edge - 0.05, -0.075, -5.15), dvec3(edge + 0.07, 0.22, 0.45), 0.014));
  append(trim, chamfered_box(dvec3(edge - 0.05, -0.075, 3.75), dvec3(edge + 0.07, 0.22, 6.27), 0.014));
  place_once(scene, to_mesh("terrace trim", trim, palette.pale_stone, 20.0));

  constexpr int risers = 8;
  constexpr double rise = terrace / risers;
  constexpr double going = 0.32;
  const std::uint32_t step = add_mesh(
      scene,
      to_mesh("step", chamfered_box(dvec3(-0.38, -0.21, -1.53), dvec3(0, 0, 1.53), 0.012), palette.limestone, 20.0));
  for (int i = 0; i + 1 < risers; ++i) {
    place(scene, step, "step",
          moved(dvec3(edge + going * (risers - 1 - i), rise * (i + 1), 2.1 + (i % 2 == 0 ? 0.0 : 0.004))));
  }
  const dvec2 foot[] = {{-7.03, -0.065}, {-6.62, -0.065}, {-4.75, -0.065}, {-4.3, -0.065}};
  const dvec2 top[] = {{-7.03, 1.72}, {-6.62, 1.72}, {-4.75, 0.62}, {-4.3, 0.62}};
  const std::uint32_t cheek = add_mesh(scene, to_mesh("stair cheek", band(foot, top, 0.34), palette.plaster, 20.0));
  const dvec2 cap_foot[] = {{-7.0, 1.71}, {-6.61, 1.71}, {-4.75, 0.615}, {-4.28, 0.615}};
  const dvec2 cap_top[] = {{-7.0, 1.79}, {-6.59, 1.79}, {-4.73, 0.695}, {-4.28, 0.695}};
  const std::uint32_t cap =
      add_mesh(scene, to_mesh("cheek cap", band(cap_foot, cap_top, 0.42), palette.pale_stone, 20.0));
  Shape stand = chamfered_box(dvec3(-0.29, -0.07, -0.29), dvec3(0.29, 0.16, 0.29), 0.012);
  append(stand, chamfered_box(dvec3(-0.24, 0.15, -0.24), dvec3(0.24, 0.86, 0.24), 0.012));
  append(stand, chamfered_box(dvec3(-0.3, 0.85, -0.3), dvec3(0.3, 0.96, 0.3), 0.02));
  const std::uint32_t pedestal = add_mesh(scene, to_mesh("pedestal", stand, palette.limestone, 20.0));
  for (const double z : {0.45, 3.75}) {
    place(scene, cheek, "stair cheek", moved(dvec3(0, 0, z - 0.17)));
    place(scene, cap, "cheek cap", moved(dvec3(0, 0, z - 0.21)));
    place(scene, pedestal, "pedestal", moved(dvec3(-4.28, 0, z)));
  }

  Shape post = chamfered_box(dvec3(-0.2, 1.33, -0.2), dvec3(0.2, 2.24, 0.2), 0.012);
  append(post, chamfered_box(dvec3(-0.25, 2.22, -0.25), dvec3(0.25, 2.32, 0.25), 0.018));
  append(post, finial(0.15), moved(dvec3(0, 2.32, 0)));
  const std::uint32_t posts = add_mesh(scene, to_mesh("balustrade pier", post, palette.limestone, 30.0));
  for (const dvec2 at :
       {dvec2(edge, 0.45), dvec2(edge, 3.75), dvec2(edge, 6.16), dvec2(edge, -2.25), dvec2(-9.0, 6.16)}) {
    place(scene, posts, "balustrade pier", moved(dvec3(at.x, 0, at.y)));
  }
  const std::uint32_t turning = add_mesh(scene, to_mesh("baluster", baluster(), palette.pale_stone, 32.0));
  Shape rails;
  double lift = 0.0;
  struct Run {
    dvec2 from, to;
  };
  for (const Run& run :
       {Run{{edge, -5.1}, {edge, -2.25}}, Run{{edge, -2.25}, {edge, 0.45}}, Run{{edge, 3.75}, {edge, 6.16}},
        Run{{-9.0, 6.16}, {edge, 6.16}}, Run{{-11.1, 6.16}, {-9.0, 6.16}}}) {
    const dvec2 half = run.from.x == run.to.x ? dvec2(1, 0) : dvec2(0, 1);
    const auto rail = [&](double low, double high, double width) {
      const dvec2 a = run.from - width * half, b = run.to + width * half;
      append(rails, chamfered_box(dvec3(a.x, low, a.y), dvec3(b.x, high, b.y), 0.014));
    };
    // Runs meet within the piers; each lies a little higher than the one before.
    rail(1.35 + lift, 1.46 + lift, 0.11);
    rail(2.07 + lift, 2.17 + lift, 0.13);
    lift += 0.0005;
    const double length = glm::length(run.to - run.from) - 0.4;
    const dvec2 along = glm::normalize(run.to - run.from);
    const int count = static_cast<int>(length / 0.215);
    for (int i = 0; i < count; ++i) {
      const dvec2 at = run.from + along * (0.2 + length * (i + 0.5) / count);
      place(scene, turning, "baluster", moved(dvec3(at.x, 1.455, at.y)));
    }
  }
  place_once(scene, to_mesh("balustrade rails", rails, palette.pale_stone, 20.0));
}

}  // namespace umbrameter::builtin
