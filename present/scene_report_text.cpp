#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "present/scene_report.h"
#include "reports/files/text_layout.h"
#include "scenes/emitter.h"
#include "scenes/light.h"

namespace umbrameter {
namespace {

constexpr std::size_t max_listed = 12;
constexpr std::size_t longest_name = 28;
constexpr std::size_t label_width = 11;
constexpr std::size_t line_width = 100;

using Cells = std::vector<std::vector<std::string>>;

class Lines {
 public:
  /// Label in its column, text wrapped beside it.
  void add(std::string_view label, const std::string& text) {
    for (const std::string& line : wrap_lines(text, line_width - label_width)) put(label, line);
  }
  /// A numbered row for each of the first items, then how many are left.
  template <class T>
  void add_list(std::string_view label, const std::vector<T>& items, std::vector<std::string> (*row)(const T&)) {
    Cells rows;
    for (std::size_t i = 0; i < std::min(items.size(), max_listed); ++i) {
      std::vector<std::string>& cells = rows.emplace_back();
      cells.push_back(fmt::format("{:>2}", i));
      cells.push_back(items[i].name.empty() ? "(no name)" : shortened(items[i].name, longest_name));
      for (std::string& cell : row(items[i])) cells.push_back(std::move(cell));
    }
    if (items.empty()) put(label, "none");
    for (const std::string& line : aligned(rows)) put(label, line);
    if (items.size() > max_listed) {
      put(label, fmt::format("… and {} more (--json lists all)", grouped(items.size() - max_listed)));
    }
  }
  void add_rows(std::string_view label, const Cells& rows) {
    for (const std::string& line : aligned(rows)) put(label, line);
  }
  std::vector<std::string> take() { return std::move(lines_); }

 private:
  // A label stands once, before its first line.
  void put(std::string_view& label, const std::string& text) {
    lines_.push_back(fmt::format("{:<{}}{}", label, label_width, text));
    label = {};
  }
  std::vector<std::string> lines_;
};

std::string counted(std::size_t number, const char* noun, const char* plural = "s") {
  return grouped(number) + " " + noun + (number == 1 ? "" : plural);
}

std::string metres(double value) { return std::isinf(value) ? "infinity" : fmt::format("{:.4g} m", value); }

std::string vector_of(const dvec3& v) { return vector_text(v.x, v.y, v.z); }

// Four digits are enough of a unit vector.
std::string direction_of(const dvec3& v) {
  const dvec3 rounded = glm::round(v * 1e4) / 1e4;
  return vector_of(rounded);
}

std::string degrees_of(double radians) { return fmt::format("{:.4g}°", radians * 180.0 / pi); }

std::vector<std::string> camera_row(const Camera& camera) {
  const std::string place = "at " + vector_of(dvec3(camera.world_from_camera[3])) + " m";
  if (const auto* lens = std::get_if<PerspectiveProjection>(&camera.projection)) {
    return {"vertical field of view " + degrees_of(lens->vertical_fov), place,
            "sees " + metres(lens->near_plane) + " to " + metres(lens->far_plane)};
  }
  const auto& parallel = std::get<OrthographicProjection>(camera.projection);
  return {fmt::format("orthographic, {:.4g} m high", 2.0 * parallel.half_height), place,
          "sees " + metres(parallel.near_plane) + " to " + metres(parallel.far_plane)};
}

std::string range_text(double range) { return range > 0.0 ? ", range " + metres(range) : ""; }

std::vector<std::string> light_row(const Light& light) {
  const std::string kind(kind_of(light));
  const std::string extent = is_area(light) ? ", " + extent_text(light.emitter) : "";
  if (std::holds_alternative<DirectionalLight>(light.shape)) {
    return {kind, fmt::format("{:.6g} lx", light.intensity), "shines along " + direction_of(light.axis()) + extent};
  }
  std::string where = "at " + vector_of(light.position()) + " m";
  if (const auto* spot = std::get_if<SpotLight>(&light.shape)) {
    where +=
        fmt::format(", half cone {} to {}", degrees_of(spot->inner_cone_angle), degrees_of(spot->outer_cone_angle));
    where += range_text(spot->range);
  } else {
    where += range_text(std::get<PointLight>(light.shape).range);
  }
  return {kind, fmt::format("{:.6g} cd", light.intensity), where + extent};
}

std::vector<std::string> material_row(const Material& material) {
  std::string alpha = "opaque";
  if (material.alpha_mode == AlphaMode::blend) alpha = "blend";
  if (material.alpha_mode == AlphaMode::mask) alpha = fmt::format("mask, alpha >= {:.4g}", material.alpha_cutoff);
  const std::string texture =
      material.base_color_texture ? fmt::format("texture {}", *material.base_color_texture) : "no texture";
  return {alpha, texture, material.double_sided ? "double-sided" : ""};
}

std::vector<std::string> texture_row(const Texture& texture) {
  if (texture.texels.empty()) return {"no texels"};
  return {fmt::format("{}×{}", texture.texels.width, texture.texels.height),
          bytes_text(texture.texels.size() * sizeof(glm::u8vec4))};
}

std::vector<std::string> bytes_row(const std::string& of, const SceneBytes& bytes) {
  return {of,
          bytes_text(bytes.total()),
          bytes_text(bytes.vertices),
          bytes_text(bytes.indices),
          bytes_text(bytes.instances),
          bytes_text(bytes.textures)};
}

void add_units(Lines& lines, const UnitGuess& guess, const std::string& unit) {
  const std::string read_as =
      unit == "m" ? "metres (the unit of glTF)" : "read with --scene.unit " + shortened(unit, 20);
  if (guess.verdict == SizeVerdict::credible) {
    lines.add("units", read_as + "; the size is plausible");
    return;
  }
  std::string text = fmt::format("{}; the size is {}: {}.", read_as,
                                 guess.verdict == SizeVerdict::implausible ? "implausible" : "doubtful", guess.reason);
  for (std::size_t i = 0; i < guess.candidates.size(); ++i) {
    const UnitCandidate& candidate = guess.candidates[i];
    text += fmt::format("{}{} in {}", i == 0 ? " The longest side would be " : ", ", metres(candidate.longest_side),
                        candidate.unit);
  }
  lines.add("units", text + (guess.candidates.empty() ? " No common unit gives a plausible size." : "."));
}

void add_memory(Lines& lines, const SceneReport& report) {
  lines.add_rows("memory", {{"computed", "total", "vertices", "indices", "instances", "textures"},
                            bytes_row("scene", report.memory),
                            bytes_row("GPU", report.gpu)});
  const std::string tracer = report.tracer_bytes ? bytes_text(*report.tracer_bytes) : "—";
  lines.add_rows("", {{"measured", "total"},
                      {"tracer", tracer, report.tracer_bytes ? "Embree's count" : "not built; use --measure-memory"},
                      {"loading", bytes_text(report.peak_resident),
                       fmt::format("peak of the process while loading; {:.2g} s", report.load_seconds)}});
}

}  // namespace

std::string extent_text(const Emitter& emitter) {
  if (const auto* sphere = std::get_if<SphereEmitter>(&emitter)) return "sphere of radius " + metres(sphere->radius);
  if (const auto* disk = std::get_if<DiskEmitter>(&emitter)) return "disk of radius " + metres(disk->radius);
  if (const auto* rectangle = std::get_if<RectangleEmitter>(&emitter)) {
    return fmt::format("rectangle of {:.6g} × {:.6g} m", rectangle->width, rectangle->height);
  }
  if (const auto* distant = std::get_if<DistantEmitter>(&emitter)) {
    return degrees_of(distant->angular_diameter) + " across";
  }
  return {};
}

std::vector<std::string> to_lines(const SceneReport& report) {
  const Scene& scene = report.scene;
  Lines lines;
  lines.add("scene", shortened(report.source, 400) + (report.part.empty() ? "" : ", scene " + report.part));
  lines.add("triangles", fmt::format("{} in all, {} stored; {} vertices", grouped(report.counts.triangles),
                                     grouped(report.counts.stored_triangles), grouped(report.counts.vertices)));
  lines.add("parts", counted(scene.objects.size(), "object") + ", " + counted(scene.instances.size(), "instance") +
                         " of " + counted(scene.meshes.size(), "mesh", "es") + ", " +
                         counted(scene.materials.size(), "material") + ", " +
                         counted(scene.textures.size(), "texture"));
  if (!report.bounds.empty()) {
    const dvec3 extent = report.bounds.extent();
    // A thousandth of the longest side; more digits say nothing about the scene.
    const double longest = std::max({extent.x, extent.y, extent.z});
    const double step = longest > 0.0 ? std::pow(10.0, std::floor(std::log10(longest)) - 3.0) : 1.0;
    const auto rounded = [&](const dvec3& v) { return longest > 0.0 ? glm::round(v / step) * step : v; };
    lines.add("bounds", vector_of(rounded(report.bounds.min)) + " to " + vector_of(rounded(report.bounds.max)) + " m");
    lines.add("extent", fmt::format("{:.4g} × {:.4g} × {:.4g} m (X × Y × Z)", extent.x, extent.y, extent.z));
    add_units(lines, report.units, report.unit);
  }
  lines.add_list("cameras", scene.cameras, camera_row);
  lines.add_list("lights", scene.lights, light_row);
  lines.add_list("materials", scene.materials, material_row);
  lines.add_list("textures", scene.textures, texture_row);
  add_memory(lines, report);
  for (const std::string& text : scene.notes) lines.add("note", shortened(text, 1000));
  return lines.take();
}

}  // namespace umbrameter
