#include "scenes/builtin/fence.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "scenes/builtin/parts.h"
#include "scenes/builtin/placing.h"
#include "scenes/builtin/scenes.h"

namespace umbrameter::builtin {
namespace {

constexpr int width = 320, height = 192;
// A power of two, so that every edge of the geometry is where the mask's texel ends, to the last bit.
constexpr double texel = 1.0 / 128.0;

// sRGB; the linear colour of the geometry is the same.
constexpr glm::u8vec4 green{74, 104, 92, 255};
constexpr vec3 linear_green{0.0685f, 0.1384f, 0.1070f};

}  // namespace

std::vector<TexelRectangle> fence_pattern() {
  std::vector<TexelRectangle> bars;
  const auto add = [&](int x, int y, int across, int up) { bars.push_back({x, y, x + across, y + up}); };
  add(0, 0, 7, 176);
  add(width - 7, 0, 7, 176);
  for (const auto& [y, thick] : {std::pair{8, 6}, {44, 5}, {132, 4}, {156, 6}}) add(0, y, width, thick);
  // Pickets with crossed heads; every second one is thinner and lower.
  for (int i = 0; i < 19; ++i) {
    const bool tall = i % 2 == 0;
    const int x = 15 + 16 * i, across = tall ? 4 : 2;
    add(x - across / 2, 49, across, tall ? 138 : 122);
    if (tall) add(x - 5, 176, 10, 4);
    // Studs between the two upper rails.
    add(x + 5, 142, 6, 8);
  }
  // A meander between the two lower rails.
  for (int x = 10; x + 24 <= width - 7; x += 25) {
    add(x, 14, 3, 25);
    add(x, 36, 19, 3);
    add(x + 16, 20, 3, 16);
    add(x + 7, 20, 9, 3);
    add(x + 7, 20, 3, 10);
  }
  // A field of wires, one texel each.
  for (int y = 62; y < 120; y += 6) add(112, y, 96, 1);
  for (int x = 113; x < 208; x += 6) add(x, 58, 1, 64);
  for (const int y : {55, 122}) add(108, y, 104, 3);
  return bars;
}

Texture fence_mask() {
  Texture texture;
  texture.name = "fence";
  texture.wrap_u = Wrap::clamp_to_edge;
  texture.wrap_v = Wrap::clamp_to_edge;
  texture.texels = Image<glm::u8vec4>(width, height, glm::u8vec4(green.x, green.y, green.z, 0));
  for (const TexelRectangle& bar : fence_pattern()) {
    for (int y = bar.y0; y < bar.y1; ++y) {
      for (int x = bar.x0; x < bar.x1; ++x) texture.texels.at(x, height - 1 - y) = green;
    }
  }
  return texture;
}

Sheet fence_geometry() {
  const std::vector<TexelRectangle> bars = fence_pattern();
  std::vector<int> columns, rows;
  for (const TexelRectangle& bar : bars) {
    columns.insert(columns.end(), {bar.x0, bar.x1});
    rows.insert(rows.end(), {bar.y0, bar.y1});
  }
  for (std::vector<int>* cuts : {&columns, &rows}) {
    std::sort(cuts->begin(), cuts->end());
    cuts->erase(std::unique(cuts->begin(), cuts->end()), cuts->end());
  }
  // Cells of a common grid: no two overlap, and neighbours share their corners.
  Sheet sheet;
  std::vector<std::uint32_t> ids(columns.size() * rows.size(), 0);
  const auto point = [&](std::size_t i, std::size_t j) {
    std::uint32_t& id = ids[j * columns.size() + i];
    if (id == 0) {
      sheet.points.emplace_back(texel * columns[i], texel * rows[j], 0.0);
      id = static_cast<std::uint32_t>(sheet.points.size());
    }
    return id - 1;
  };
  for (std::size_t j = 0; j + 1 < rows.size(); ++j) {
    for (std::size_t i = 0; i + 1 < columns.size(); ++i) {
      const bool is_solid = std::any_of(bars.begin(), bars.end(), [&](const TexelRectangle& bar) {
        return bar.x0 <= columns[i] && columns[i + 1] <= bar.x1 && bar.y0 <= rows[j] && rows[j + 1] <= bar.y1;
      });
      if (!is_solid) continue;
      const std::uint32_t a = point(i, j), b = point(i + 1, j), c = point(i + 1, j + 1), d = point(i, j + 1);
      sheet.faces.push_back({a, b, c});
      sheet.faces.push_back({a, c, d});
    }
  }
  return sheet;
}

Scene make_fence() {
  Scene scene;
  scene.name = "fence";
  const std::uint32_t stone = add_material(scene, "limestone", {0.60f, 0.54f, 0.44f});
  const std::uint32_t pale = add_material(scene, "pale limestone", {0.66f, 0.61f, 0.51f});
  const std::uint32_t warm = add_material(scene, "warm limestone", {0.56f, 0.49f, 0.38f});
  const std::uint32_t iron = add_material(scene, "iron", {0.035f, 0.038f, 0.038f});
  const std::uint32_t candle = add_material(scene, "candle", {0.80f, 0.74f, 0.60f});
  const std::uint32_t masked = add_textured_material(scene, "fence mask", fence_mask(), true);
  const std::uint32_t solid = add_sheet_material(scene, "fence geometry", linear_green);

  place_once(scene, to_mesh("ground", chamfered_box({-9, -0.4, -7}, {9, 0, 9}, 0.02), warm));
  const std::uint32_t plinth =
      add_mesh(scene, to_mesh("plinth", chamfered_box({-0.05, -0.1, -0.17}, {2.55, 0.32, 0.17}, 0.03), stone));
  const std::uint32_t pillar =
      add_mesh(scene, to_mesh("pillar", chamfered_box({-0.2, -0.1, -0.22}, {0.2, 2.0, 0.22}, 0.025), stone));
  const std::uint32_t cap =
      add_mesh(scene, to_mesh("cap", chamfered_box({-0.28, 1.95, -0.3}, {0.28, 2.1, 0.3}, 0.04), pale));
  const std::uint32_t ball = add_mesh(scene, to_mesh("finial", finial(0.19), pale));

  const double panel = width * texel, gap = 0.4, foot = 0.36;
  const double left = -panel - 0.5 * gap, right = 0.5 * gap;
  for (const double x : {left, right}) place(scene, plinth, "plinth", moved({x, 0.0, 0.0}));
  for (const double x : {left - 0.5 * gap, 0.0, right + panel + 0.5 * gap}) {
    place(scene, pillar, "pillar", moved({x, 0.0, 0.0}));
    place(scene, cap, "cap", moved({x, 0.0, 0.0}));
    place(scene, ball, "finial", moved({x, 2.09, 0.0}));
  }
  Sheet card;
  const dvec3 half{0.5 * panel, 0.5 * height * texel, 0.0};
  add_card(card, half, {half.x, 0, 0}, {0, half.y, 0});
  place_once(scene, to_mesh("fence mask", card, masked), moved({left, foot, 0.0}));
  place_once(scene, to_mesh("fence geometry", fence_geometry(), solid), moved({right, foot, 0.0}));
  const dvec3 lamp{0.0, 1.35, -1.5};
  place_once(scene, to_mesh("lamp post", chamfered_box({-0.05, -0.1, -1.75}, {0.05, 3.06, -1.65}, 0.01), iron));
  place_once(scene, to_mesh("lamp arm", chamfered_box({-0.035, 2.9, -1.8}, {0.035, 2.97, -1.4}, 0.01), iron));
  place_once(scene, to_mesh("lantern", lantern_frame(), iron), moved(lamp));
  place_once(scene, to_mesh("candle", lantern_light(), candle), moved(lamp));

  add_camera(scene, "front", looking(dvec3(-1.4, 3.3, 9.4), dvec3(0.2, 0.66, 0.6)), 32.0);
  add_camera(scene, "mask and geometry", looking(dvec3(0.0, 1.5, 3.3), dvec3(0.0, 0.95, 0.0)), 42.0);
  add_camera(scene, "along", looking(dvec3(5.6, 1.9, 4.4), dvec3(-0.9, 0.5, 0.55)), 36.0);
  const double elevation = degrees(34.0);
  const dvec3 to_sun{-0.42 * std::cos(elevation), std::sin(elevation), -0.91 * std::cos(elevation)};
  add_sun(scene, "sun", dvec3(0.0), to_sun, 15.0, 3.0);
  Light spot;
  spot.name = "spot";
  spot.world_from_light = looking(dvec3(0.9, 4.2, -3.4), dvec3(0.0, 0.3, 1.0));
  spot.color = {1.0f, 0.88f, 0.70f};
  spot.intensity = 45.0;
  spot.shape = SpotLight{16.0, degrees(26.0), degrees(36.0)};
  scene.lights.push_back(spot);
  // Between the candle and the crown of the lantern.
  Light point;
  point.name = "lantern";
  point.world_from_light = looking(lamp + dvec3(0, 0.27, 0), lamp + dvec3(0, 0.27, 1));
  point.color = {1.0f, 0.72f, 0.40f};
  point.intensity = 6.0;
  point.shape = PointLight{14.0};
  scene.lights.push_back(point);
  return scene;
}

}  // namespace umbrameter::builtin
