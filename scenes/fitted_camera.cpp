#include "scenes/fitted_camera.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "core/parallel.h"
#include "scenes/short_number.h"
#include "scenes/view_content.h"

namespace umbrameter {
namespace {

constexpr double degree = pi / 180.0;
constexpr double usual_azimuth = 30.0;    // degrees from +Z towards +X
constexpr double usual_elevation = 25.0;  // degrees
// Of the best score: the usual view is kept from the first on, and another is as good as the best from the second on.
constexpr double good_enough = 0.5;
constexpr double as_good = 0.8;
// By how much a view from inside must be better than the usual one, where fronts close the room and where they do not.
constexpr double better_inside = 1.5;
constexpr double much_better_inside = 2.0;
constexpr double room_fov = 1.0;  // radians

dvec3 direction_of(double azimuth, double elevation) {
  const double a = azimuth * degree;
  const double e = elevation * degree;
  return {std::sin(a) * std::cos(e), std::sin(e), std::cos(a) * std::cos(e)};
}

// Where the axis must pass so that what is seen reaches equally far to both sides of it: with `across` and `towards`
// the places of points across the image and towards the camera, max + min of (across − shift) / (distance − towards) is
// 0. It falls with the shift, so it is bisected.
double balanced_shift(const std::array<double, 8>& across, const std::array<double, 8>& towards, double distance) {
  double low = *std::ranges::min_element(across);
  double high = *std::ranges::max_element(across);
  for (int step = 0; step < 60; ++step) {
    const double shift = 0.5 * (low + high);
    double max = -std::numeric_limits<double>::infinity();
    double min = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < across.size(); ++i) {
      const double seen = (across[i] - shift) / (distance - towards[i]);
      max = std::max(max, seen);
      min = std::min(min, seen);
    }
    (max + min > 0.0 ? low : high) = shift;
  }
  return 0.5 * (low + high);
}

// The nearest position along a direction from which each corner of the box is within the image.
Camera camera_around(const Bounds& bounds, const dvec3& direction, double aspect) {
  constexpr double margin = 0.94;
  Camera camera;
  camera.name = "fitted";
  PerspectiveProjection lens;
  const dmat4 axes = frame_towards(direction, dvec3(0));
  const dvec2 tangent = margin * std::tan(0.5 * lens.vertical_fov) * dvec2(aspect, 1.0);
  const dvec3 center = bounds.empty() ? dvec3(0) : bounds.center();
  const double radius = std::max(bounds.radius(), 1e-6 * (1.0 + glm::length(center)));
  // Each corner at (x, y, z) of the camera's axes asks |x − shift| ≤ tangent · (distance − z), likewise for y.
  const double infinite = std::numeric_limits<double>::infinity();
  dvec2 upper(-infinite);
  dvec2 lower(-infinite);
  std::array<std::array<double, 8>, 3> corners{};
  for (std::size_t i = 0; i < 8; ++i) {
    const dvec3 offset = bounds.empty() ? dvec3(0) : bounds.corner(static_cast<int>(i)) - center;
    const dvec3 local = glm::transpose(dmat3(axes)) * offset;
    upper = glm::max(upper, dvec2(local) + tangent * local.z);
    lower = glm::max(lower, -dvec2(local) + tangent * local.z);
    for (int c = 0; c < 3; ++c) corners[static_cast<std::size_t>(c)][i] = local[c];
  }
  const double nearest = *std::ranges::max_element(corners[2]);
  const dvec2 needed = (upper + lower) / (2.0 * tangent);
  const double distance = std::max({needed.x, needed.y, nearest + 0.1 * radius});
  const dvec2 shift{balanced_shift(corners[0], corners[2], distance), balanced_shift(corners[1], corners[2], distance)};
  camera.world_from_camera =
      frame_towards(direction, center + distance * direction + dvec3(axes[0]) * shift.x + dvec3(axes[1]) * shift.y);
  lens.near_plane = 0.5 * (distance - nearest);
  camera.projection = lens;
  return camera;
}

struct Candidate {
  Camera camera;
  std::string place;  ///< "from 210 degrees …", for the note
  ViewContent content{};

  double score = 0.0;
};

// Shadows are measured on surfaces that face a light. From a side at random, half of what a body shows does: less is a
// fault, unless no view shows any.
double lit_share(const ViewContent& content, bool any_is_lit) {
  return any_is_lit && content.lit < 0.5 * content.seen ? content.lit / (0.5 * content.seen) : 1.0;
}

// More surfaces in more of the image, that face a light, not through back faces. What one plane shows counts 1 with the
// whole image.
void score(std::vector<Candidate>& candidates, bool any_is_lit) {
  for (Candidate& candidate : candidates) {
    const ViewContent& content = candidate.content;
    candidate.score = std::sqrt(content.seen) * (1.0 + content.variety) * lit_share(content, any_is_lit) *
                      (1.0 - content.behind_of_covered()) * (1.0 - content.cut);
  }
}

bool any_is_lit(const std::vector<Candidate>& candidates) {
  return std::ranges::any_of(candidates, [](const Candidate& candidate) { return candidate.content.lit > 0.0; });
}

void judge(std::vector<Candidate>& candidates, const TriangleSample& sample, double aspect) {
  parallel_for(candidates.size(),
               [&](std::size_t i) { candidates[i].content = look(sample, candidates[i].camera, aspect); });
}

std::string vector_text(const dvec3& v) {
  return std::string("(") + text_of(v.x) + ", " + text_of(v.y) + ", " + text_of(v.z) + ")";
}

std::string direction_text(double azimuth, double elevation) {
  return text_of(azimuth) + " degrees from the front (+Z) towards +X and " + text_of(std::abs(elevation)) +
         (elevation < 0.0 ? " degrees below" : " degrees above");
}

// The box of what is left when the middle part of all triangles is kept along each axis.
Bounds middle_part(const TriangleSample& sample) {
  constexpr double outside = 0.02;
  Bounds box;
  box.min = dvec3(0);
  box.max = dvec3(0);
  double sum = 0.0;
  for (const SampledTriangle& triangle : sample.triangles) sum += static_cast<double>(triangle.weight);
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<std::pair<double, double>> places;
    for (const SampledTriangle& triangle : sample.triangles) {
      const auto& [a, b, c] = triangle.corners;
      places.emplace_back((static_cast<double>(a[axis]) + b[axis] + c[axis]) / 3.0, triangle.weight);
    }
    std::ranges::sort(places);
    double before = 0.0;
    bool is_begun = false;
    for (const auto& [place, weight] : places) {
      if (!is_begun && before + weight > outside * sum) {
        box.min[axis] = place;
        is_begun = true;
      }
      if (before < (1.0 - outside) * sum) box.max[axis] = place;
      before += weight;
    }
  }
  return box;
}

// The box of all objects but those that are as wide as the scene and flat, or as large as the scene: grounds and skies.
Bounds without_backdrops(const TriangleSample& sample) {
  constexpr double wide = 0.6;
  constexpr double flat = 0.02;
  std::vector<Bounds> boxes;
  Bounds all;
  for (const SampledTriangle& triangle : sample.triangles) {
    if (boxes.size() <= triangle.object) boxes.resize(triangle.object + std::size_t{1});
    for (const vec3& corner : triangle.corners) boxes[triangle.object].include(dvec3(corner));
  }
  for (const Bounds& box : boxes) all.include(box);
  Bounds rest;
  if (all.empty()) return rest;
  const dvec3 whole = all.extent();
  for (const Bounds& box : boxes) {
    if (box.empty()) continue;
    const dvec3 extent = box.extent();
    const bool is_wide = extent.x >= wide * whole.x && extent.z >= wide * whole.z;
    const bool is_flat = extent.y <= flat * std::max(extent.x, extent.z);
    const bool is_whole = extent.y >= wide * whole.y;
    if (!is_wide || (!is_flat && !is_whole)) rest.include(box);
  }
  return rest;
}

// Parts of the scene that may be all that matters: much smaller than it. World coordinates.
std::vector<Bounds> detailed_parts(const TriangleSample& sample) {
  constexpr double much_smaller = 0.5;
  constexpr double margin = 0.1;
  std::vector<Bounds> parts;
  for (const Bounds& part : {without_backdrops(sample), middle_part(sample)}) {
    if (part.empty() || part.radius() <= 0.0 || part.radius() > much_smaller) continue;
    const dvec3 half = 0.5 * (1.0 + margin) * sample.radius() * part.extent();
    const dvec3 center = sample.center() + sample.radius() * part.center();
    parts.push_back({center - half, center + half});
  }
  return parts;
}

// Views from around, above and, without a ground, below.
void add_around(std::vector<Candidate>& candidates, const Bounds& part, double aspect, bool is_whole, bool has_ground) {
  const std::string what = is_whole
                               ? "fitted to its bounds,"
                               : "fitted to the part with most detail, " + vector_text(part.extent()) + " m large,";
  for (const double elevation : {usual_elevation, 55.0, 85.0, -25.0, -55.0}) {
    if (has_ground && elevation < 0.0) continue;
    for (const double beside : {0.0, -60.0, 60.0, -120.0, 120.0, 180.0}) {
      const double azimuth = usual_azimuth + beside;
      if (elevation > 80.0 && beside != 0.0) continue;
      Candidate& added = candidates.emplace_back();
      added.camera = camera_around(part, direction_of(azimuth, elevation), aspect);
      added.place = what + " " + direction_text(azimuth, elevation);
      if (is_whole) continue;
      // What is not part of it may be before it.
      std::get<PerspectiveProjection>(added.camera.projection).near_plane *= 0.05;
    }
  }
}

Camera camera_within(const Bounds& bounds, const dvec3& eye, const dvec3& towards_viewer, double fov) {
  const dvec3 extent = bounds.extent();
  Camera camera;
  camera.name = "fitted";
  camera.world_from_camera = frame_towards(towards_viewer, eye);
  camera.projection = PerspectiveProjection{fov, 0.01 * std::min({extent.x, extent.y, extent.z})};
  return camera;
}

// How far surfaces surround a point: 1 when each direction from it meets one that the camera sees.
ViewContent surroundings(const TriangleSample& sample, const dvec3& eye) {
  // The six faces of a cube; straight up and down need another axis for "up", which a slight tilt gives.
  constexpr double almost = 1e-3;
  ViewContent mean;
  for (const dvec3& way :
       {dvec3(1, 0, 0), dvec3(-1, 0, 0), dvec3(0, 0, 1), dvec3(0, 0, -1), dvec3(almost, 1, 0), dvec3(almost, -1, 0)}) {
    const ViewContent content = look(sample, camera_within(sample.bounds, eye, way, 0.5 * pi), 1.0);
    mean.seen += content.seen / 6.0;
    mean.behind += content.behind / 6.0;
    mean.front += content.front / 6.0;
    mean.cut += content.cut / 6.0;
  }
  return mean;
}

/// Views from inside a closed room, and whether the fronts of surfaces close it.
struct Interior {
  std::vector<Candidate> candidates;
  bool is_closed_by_fronts = true;
};

Interior views_inside(const TriangleSample& sample) {
  constexpr double closed = 0.95;
  constexpr double mostly = 0.7;
  constexpr double towards_corner = 0.35;
  Interior interior;
  const dvec3 extent = sample.bounds.extent();
  if (sample.triangles.empty() || std::min({extent.x, extent.y, extent.z}) <= 0.0) return interior;
  const std::array<dvec2, 5> places{dvec2(1, 1), dvec2(-1, 1), dvec2(1, -1), dvec2(-1, -1), dvec2(0, 0)};
  std::array<ViewContent, 5> around;
  const auto eye_at = [&](std::size_t i) {
    return sample.bounds.center() + towards_corner * dvec3(places[i].x * extent.x, 0, places[i].y * extent.z);
  };
  parallel_for(places.size(), [&](std::size_t i) { around[i] = surroundings(sample, eye_at(i)); });
  // A room is about its middle, or a piece of furniture is.
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (around[i].seen < closed || around[i].behind > 1.0 - closed || around[i].cut > 0.0) continue;
    interior.is_closed_by_fronts = interior.is_closed_by_fronts && around[i].front >= mostly;
    const double azimuth =
        i + 1 < places.size() ? std::atan2(places[i].x * extent.x, places[i].y * extent.z) / degree : usual_azimuth;
    Candidate& added = interior.candidates.emplace_back();
    added.camera = camera_within(sample.bounds, eye_at(i), direction_of(azimuth, 10.0), room_fov);
    added.place = "placed inside it, at " + vector_text(eye_at(i)) + " m, looking " +
                  text_of(azimuth > 0.0 ? azimuth - 180.0 : azimuth + 180.0) +
                  " degrees from the front (+Z) towards +X and 10 degrees down";
  }
  return interior;
}

std::size_t best_of(const std::vector<Candidate>& candidates) {
  double best = 0.0;
  for (const Candidate& candidate : candidates) best = std::max(best, candidate.score);
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (candidates[i].score >= as_good * best) return i;
  }
  return 0;
}

std::string fault_of(const ViewContent& usual, bool is_inside) {
  if (usual.covered == 0.0) return "shows nothing";
  if (usual.behind_of_covered() > 0.5) return "looks mostly through back faces";
  if (is_inside) return "shows a closed room from outside";
  if (usual.lit < 0.5 * usual.seen) return "shows mostly surfaces that face away from the light";
  return "shows little but one surface";
}

}  // namespace

dmat4 frame_towards(const dvec3& towards_viewer, const dvec3& origin) {
  const dvec3 z = glm::normalize(towards_viewer);
  const dvec3 x = glm::normalize(glm::cross(dvec3(0, 1, 0), z));
  const dvec3 y = glm::cross(z, x);
  return {dvec4(x, 0), dvec4(y, 0), dvec4(z, 0), dvec4(origin, 1)};
}

FittedCamera fit_camera(const Scene& scene, double aspect) {
  const std::string remedy = "; add a camera to the file to choose another view";
  const TriangleSample sample = sample_triangles(scene);
  std::vector<Candidate> candidates;
  const bool has_ground = scene.ground.has_value();
  add_around(candidates, sample.bounds, aspect, true, has_ground);
  for (const Bounds& part : detailed_parts(sample)) add_around(candidates, part, aspect, false, has_ground);
  judge(candidates, sample, aspect);
  Interior interior = views_inside(sample);
  judge(interior.candidates, sample, aspect);
  const bool is_lit = any_is_lit(candidates) || any_is_lit(interior.candidates);
  score(candidates, is_lit);
  score(interior.candidates, is_lit);

  const Candidate& usual = candidates.front();
  const Candidate* chosen = &candidates[best_of(candidates)];
  if (usual.score >= good_enough * chosen->score) chosen = &usual;
  bool is_inside = false;
  if (!interior.candidates.empty()) {
    const Candidate& inside = interior.candidates[best_of(interior.candidates)];
    const double needed = interior.is_closed_by_fronts ? better_inside : much_better_inside;
    is_inside = inside.score > needed * usual.score && inside.score > as_good * chosen->score;
    if (is_inside) chosen = &inside;
  }
  if (chosen == &usual) {
    return {usual.camera,
            "the scene has no camera: one was fitted to its bounds, 30 degrees from the front (+Z) and 25 degrees "
            "above" +
                remedy};
  }
  return {chosen->camera, "the scene has no camera: one was " + chosen->place +
                              "; the usual view, 30 degrees from "
                              "the front (+Z) and 25 degrees above, " +
                              fault_of(usual.content, is_inside) + remedy};
}

std::string camera_remark(const Scene& scene, const Camera& camera, double aspect) {
  constexpr double max_behind = 0.5;
  constexpr double max_cut = 0.01;
  const ViewContent content = look(sample_triangles(scene), camera, aspect);
  const std::string name = camera.name.empty() ? "the camera" : "camera '" + camera.name.substr(0, 60) + "'";
  // Behind a surface that is cut away there are often back faces: the cut is then the cause.
  if (content.cut > max_cut && (content.behind <= max_behind || content.cut > max_behind)) {
    return name + " is so near to surfaces that its near plane, at " +
           text_of(std::get<PerspectiveProjection>(camera.projection).near_plane) + " m, cuts them away in " +
           text_of(100.0 * content.cut) + " % of the image: it may be inside an object; move it, or lower znear";
  }
  if (content.behind > max_behind) {
    return name + " looks through back faces in " + text_of(100.0 * content.behind) +
           " % of the image: it is inside an object or behind a wall, whose surface it does not see";
  }
  return {};
}

}  // namespace umbrameter
