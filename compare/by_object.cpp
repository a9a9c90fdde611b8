#include "compare/by_object.h"

#include <algorithm>
#include <cassert>
#include <numeric>

namespace umbrameter {
namespace {

std::uint64_t weight_of(const PartError& part) {
  return std::accumulate(part.wrong.begin(), part.wrong.end(), std::uint64_t{0});
}

std::vector<PartError> empty_parts(const Scene& scene, PartKind kind) {
  const bool is_object = kind == PartKind::object;
  std::vector<PartError> parts(is_object ? scene.objects.size() : scene.materials.size());
  for (std::size_t i = 0; i < parts.size(); ++i) {
    parts[i].index = static_cast<std::uint32_t>(i);
    parts[i].name = part_name(scene, kind, parts[i].index);
  }
  return parts;
}

}  // namespace

std::string part_name(const Scene& scene, PartKind kind, std::uint32_t index) {
  const bool is_object = kind == PartKind::object;
  const std::string& name = is_object ? scene.objects[index].name : scene.materials[index].name;
  return !name.empty() ? name : (is_object ? "object " : "material ") + std::to_string(index);
}

std::vector<PartError> errors_by_part(const Scene& scene, PartKind kind, const GBuffer& gbuffer, const WrongTaps& wrong,
                                      const CountedPixels& counted) {
  assert(wrong.weights.size() == counted.exclusion.size() && wrong.weights.size() == gbuffer.instance.size());
  std::vector<PartError> parts = empty_parts(scene, kind);
  for (std::size_t i = 0; i < wrong.weights.size(); ++i) {
    if (counted.exclusion[i] != PixelExclusion::none) continue;
    const Instance& placed = scene.instances[gbuffer.instance[i]];
    PartError& part = parts[kind == PartKind::object ? placed.object : scene.meshes[placed.mesh].material];
    ++part.pixels;
    for (std::size_t c = 0; c < cause_count; ++c) part.wrong[c] += wrong.weights[i][static_cast<int>(c)];
  }
  parts.erase(std::remove_if(parts.begin(), parts.end(), [](const PartError& part) { return part.pixels == 0; }),
              parts.end());
  std::ranges::stable_sort(parts, [](const PartError& a, const PartError& b) { return weight_of(a) > weight_of(b); });
  return parts;
}

Table part_table(PartKind kind, const std::vector<PartError>& parts, std::uint32_t weight_sum, std::size_t most) {
  Table table{{{kind == PartKind::object ? "object" : "material", "", "of the receiver"},
               {"pixels", "px", "counted pixels"},
               {"mae", "1", "mean absolute error of its pixels"}},
              {}};
  for (const std::string_view cause : cause_names) {
    table.columns.push_back({std::string(cause), "1", "share of its pixels"});
  }
  table.columns.push_back({"share_of_error", "1", "share of the total error of the light"});
  std::uint64_t all = 0;
  for (const PartError& part : parts) all += weight_of(part);
  for (const PartError& part : parts) {
    if (most > 0 && table.rows.size() == most) break;
    const double whole = static_cast<double>(part.pixels) * weight_sum;
    std::vector<Value> row{part.name, static_cast<std::int64_t>(part.pixels),
                           static_cast<double>(weight_of(part)) / whole};
    for (const std::uint64_t weight : part.wrong) row.emplace_back(static_cast<double>(weight) / whole);
    row.emplace_back(all > 0 ? static_cast<double>(weight_of(part)) / static_cast<double>(all) : 0.0);
    table.rows.push_back(std::move(row));
  }
  return table;
}

}  // namespace umbrameter
