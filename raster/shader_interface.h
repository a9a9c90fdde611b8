// Numbers that C++ and shaders share: binding points, uniform locations, enum values. Shaders get them as #defines,
// so that each has one home. Internal to raster.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "core/gbuffer.h"
#include "techniques/shadow/causes.h"
#include "techniques/shadow/histogram.h"
#include "techniques/shadow/map_layout.h"

namespace umbrameter {

struct ShaderSlot {
  std::string_view name;
  unsigned value;
};

/// Names as the shaders write them; numbers are unique within their kind (uniform blocks, storage buffers, ...).
inline constexpr ShaderSlot shader_slots[] = {
    {"BLOCK_VIEW", 0},
    {"BLOCK_LIGHT", 1},
    {"BLOCK_AO", 2},
    {"BLOCK_KERNEL", 3},
    {"BLOCK_RESPONSE", 4},
    {"BUFFER_INSTANCES", 0},
    {"BUFFER_ROTATIONS", 1},
    {"BUFFER_PIXELS", 2},
    {"BUFFER_AXES", 3},
    {"BUFFER_HISTOGRAM", 4},
    {"BUFFER_UNRESOLVED", 5},
    {"ATTRIBUTE_POSITION", 0},
    {"ATTRIBUTE_TEXCOORD", 1},
    {"ATTRIBUTE_INSTANCE", 2},
    {"UNIFORM_BASE_COLOR", 0},
    {"UNIFORM_ALPHA_CUTOFF", 1},
    {"UNIFORM_WRAP", 2},
    {"UNIFORM_HAS_TEXTURE", 3},
    {"UNIFORM_FIRST_PIXEL", 5},
    {"UNIFORM_END_PIXEL", 6},
    {"UNIFORM_MAP_VIEW", 7},
    {"UNIFORM_METALLIC_ROUGHNESS", 8},
    {"UNIFORM_DIELECTRIC_SPECULAR", 9},
    {"TEXTURE_BASE_COLOR", 0},
    {"TEXTURE_IDS", 1},
    {"TEXTURE_POSITION_DEPTH", 2},
    {"TEXTURE_GEOMETRIC_NORMAL", 3},
    {"TEXTURE_SHADOW_DEPTH", 4},
    {"TEXTURE_SHADOW_IDS", 5},
    {"TEXTURE_TRUTH", 6},
    {"TEXTURE_POSITIONS", 9},
    {"TEXTURE_TRIANGLES", 10},
    {"TEXTURE_NORMALS", 11},
    {"IMAGE_POSITION_DEPTH", 0},
    {"IMAGE_GEOMETRIC_NORMAL", 1},
    {"IMAGE_SHADING_NORMAL", 2},
    {"IMAGE_VISIBILITY", 3},
    {"IMAGE_WRONG", 4},
    {"GROUP_SIZE", 8},
    {"LIST_GROUP_SIZE", 64},
    {"MAX_SAMPLES", 1024},
    {"HISTOGRAM_WORDS", 16},   // a bin: two of each cause's weight, three of each square, one of each largest
    {"HISTOGRAM_SQUARES", 8},  // where they start
    {"HISTOGRAM_LARGEST", 14},
    {"UNRESOLVED_WORDS", sizeof(UnresolvedTap) / sizeof(std::uint32_t)},
    {"CAUSE_ACNE", static_cast<unsigned>(Cause::acne)},
    {"CAUSE_FALSE_OCCLUSION", static_cast<unsigned>(Cause::false_occlusion)},
    {"CAUSE_PETER_PANNING", static_cast<unsigned>(Cause::peter_panning)},
    {"CAUSE_LIGHT_LEAK", static_cast<unsigned>(Cause::light_leak)},
    {"MAX_MAP_VIEWS", max_map_views},
    {"MAP_VIEW_MARGIN", map_view_margin},
    {"MAP_ORTHOGRAPHIC", static_cast<unsigned>(MapKind::orthographic)},
    {"MAP_PERSPECTIVE", static_cast<unsigned>(MapKind::perspective)},
    {"MAP_CUBE", static_cast<unsigned>(MapKind::cube)},
};

/// The number of a slot; a name that is not in the table does not compile.
consteval unsigned slot(std::string_view name) {
  for (const ShaderSlot& candidate : shader_slots) {
    if (candidate.name == name) return candidate.value;
  }
  throw "no such slot";
}

/// slot() of a uniform, whose locations OpenGL counts in signed numbers.
consteval int location(std::string_view name) { return static_cast<int>(slot(name)); }

/// All of them as #define lines, and NO_ID.
inline std::string interface_defines() {
  std::string text = "#define NO_ID " + std::to_string(no_id) + "u\n";
  for (const ShaderSlot& entry : shader_slots) {
    text += "#define " + std::string(entry.name) + " " + std::to_string(entry.value) + "\n";
  }
  return text;
}

inline std::string define(std::string_view name, unsigned value) {
  return "#define " + std::string(name) + " " + std::to_string(value) + "\n";
}

/// Work groups that cover a side of that many pixels.
constexpr unsigned group_count(int pixels) {
  return (static_cast<unsigned>(pixels) + slot("GROUP_SIZE") - 1) / slot("GROUP_SIZE");
}

}  // namespace umbrameter
