#include "scenes/floor.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace umbrameter {
namespace {

// Places of the plan in each direction. A floor fills all of them or nearly so: how fine they are decides nothing.
constexpr int side = 64;

// The top of a crate or table is farther above its foot, for its width, than a floor is above its underside.
constexpr double thickest_floor = 1.0 / 8.0;  // of the side of a square with the plan's area

double highest_floor(const Bounds& bounds) {
  const dvec3 extent = bounds.extent();
  return std::min(bounds.center().y, bounds.min.y + thickest_floor * std::sqrt(extent.x * extent.z));
}

class Plan {
 public:
  explicit Plan(const Bounds& bounds) : bounds_(bounds), top_(highest_floor(bounds)), is_covered_(side * side, false) {}

  bool is_half_covered() const { return 2 * covered_ >= side * side; }

  // Covers the places at which the triangle is low enough.
  void add(const std::array<dvec3, 3>& corners) {
    if (std::min({corners[0].y, corners[1].y, corners[2].y}) > top_) return;
    std::array<dvec3, 3> places{};
    for (std::size_t c = 0; c < 3; ++c) places[c] = place(corners[c]);
    const auto [min_x, max_x] = std::minmax({places[0].x, places[1].x, places[2].x});
    const auto [min_z, max_z] = std::minmax({places[0].z, places[1].z, places[2].z});
    for (int z = first(min_z); z <= last(max_z); ++z) {
      for (int x = first(min_x); x <= last(max_x); ++x) cover(places, x, z);
    }
  }

 private:
  // x and z in places, whose centres are at whole numbers; y in metres.
  dvec3 place(const dvec3& world) const {
    const dvec3 extent = bounds_.extent();
    const auto in_places = [](double offset, double length) {
      return length > 0.0 ? offset / length * side - 0.5 : 0.0;
    };
    return {in_places(world.x - bounds_.min.x, extent.x), world.y, in_places(world.z - bounds_.min.z, extent.z)};
  }
  static int first(double min) { return std::max(0, static_cast<int>(std::ceil(min))); }
  static int last(double max) { return std::min(side - 1, static_cast<int>(std::floor(max))); }

  void cover(const std::array<dvec3, 3>& places, int x, int z) {
    const auto index = static_cast<std::size_t>(z * side + x);
    if (is_covered_[index]) return;
    const auto area = [](const dvec3& a, const dvec3& b, double px, double pz) {
      return (b.x - a.x) * (pz - a.z) - (b.z - a.z) * (px - a.x);
    };
    const double whole = area(places[0], places[1], places[2].x, places[2].z);
    if (whole == 0.0) return;
    double height = 0.0;
    for (std::size_t c = 0; c < 3; ++c) {
      const double weight = area(places[(c + 1) % 3], places[(c + 2) % 3], x, z) / whole;
      if (weight < 0.0) return;
      height += weight * places[c].y;
    }
    if (height > top_) return;
    is_covered_[index] = true;
    ++covered_;
  }

  Bounds bounds_;
  double top_;
  std::vector<bool> is_covered_;
  int covered_ = 0;
};

}  // namespace

bool has_floor(const Scene& scene) {
  const Bounds bounds = bounds_of(scene);
  if (bounds.empty()) return false;
  const std::vector<Bounds> boxes = boxes_of(scene);
  // The widest first: a floor ends the search.
  struct Part {
    const Instance* instance;
    double area;
  };
  std::vector<Part> parts;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    if (boxes[i].empty()) continue;
    const dvec3 extent = boxes[i].extent();
    parts.push_back({&scene.instances[i], extent.x * extent.z});
  }
  std::ranges::stable_sort(parts, [](const Part& a, const Part& b) { return a.area > b.area; });
  Plan plan(bounds);
  for (const Part& part : parts) {
    const Instance& instance = *part.instance;
    const Mesh& mesh = scene.meshes[instance.mesh];
    const bool mirrors = is_mirrored(instance.world_from_mesh);
    for (const uvec3& triangle : mesh.triangles) {
      const std::array<dvec3, 3> corners = world_corners(mesh, triangle, instance.world_from_mesh);
      const double up = glm::cross(corners[1] - corners[0], corners[2] - corners[0]).y;
      if (up != 0.0 && (up > 0.0) != mirrors) plan.add(corners);
    }
    if (plan.is_half_covered()) return true;
  }
  return false;
}

}  // namespace umbrameter
