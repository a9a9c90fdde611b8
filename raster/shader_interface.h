// Numbers that C++ and shaders share: attribute locations, sizes, enum values. Shaders get them as #defines, so that
// each has one home. Internal to raster.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "core/gbuffer.h"
#include "techniques/shadow/causes.h"
#include "techniques/shadow/histogram.h"
#include "techniques/shadow/map_depth.h"
#include "techniques/shadow/map_layout.h"
#include "techniques/shadow/normal_offset.h"

namespace umbrameter {

struct ShaderConstant {
  std::string_view name;
  unsigned value;
};

/// Names as the shaders write them.
inline constexpr ShaderConstant shader_constants[] = {
    {"ATTRIBUTE_POSITION", 0},
    {"ATTRIBUTE_TEXCOORD", 1},
    {"ATTRIBUTE_INSTANCE", 2},
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
    {"MAP_PARABOLOID", static_cast<unsigned>(MapKind::paraboloid)},
    {"DEPTH_LINEAR", shared::DEPTH_LINEAR},
    {"DEPTH_REVERSED_LINEAR", shared::DEPTH_REVERSED_LINEAR},
    {"DEPTH_PERSPECTIVE", shared::DEPTH_PERSPECTIVE},
    {"DEPTH_REVERSED_PERSPECTIVE", shared::DEPTH_REVERSED_PERSPECTIVE},
    {"DEPTH_OVER_W", shared::DEPTH_OVER_W},
    {"DEPTH_REVERSED_OVER_W", shared::DEPTH_REVERSED_OVER_W},
    {"BIAS_IN_TEXELS", static_cast<unsigned>(LengthUnit::texels)},
    {"BIAS_IN_MAP_DEPTH", static_cast<unsigned>(LengthUnit::map_depth)},
    {"OFFSET_SINE", static_cast<unsigned>(OffsetProfile::sine)},
    {"OFFSET_CONSTANT", static_cast<unsigned>(OffsetProfile::constant)},
    {"OFFSET_EEVEE", static_cast<unsigned>(OffsetProfile::eevee)},
    {"SURFACE_MIDPOINT", static_cast<unsigned>(StoredSurface::midpoint)},
    {"SURFACE_SECOND", static_cast<unsigned>(StoredSurface::second)},
    {"SURFACE_DUAL", static_cast<unsigned>(StoredSurface::dual)},
};

/// The number of that name; a name that is not in the table does not compile.
consteval unsigned constant(std::string_view name) {
  for (const ShaderConstant& candidate : shader_constants) {
    if (candidate.name == name) return candidate.value;
  }
  throw "no such constant";
}

/// All of them as #define lines, NO_ID, and the words that one of GLSL and C++ lacks.
inline std::string interface_defines() {
  std::string text =
      "#define SHARED\n#define UNUSED\n#define PRECISE precise\n#define NO_ID " + std::to_string(no_id) + "u\n";
  for (const ShaderConstant& entry : shader_constants) {
    text += "#define " + std::string(entry.name) + " " + std::to_string(entry.value) + "\n";
  }
  return text;
}

inline std::string define(std::string_view name, unsigned value) {
  return "#define " + std::string(name) + " " + std::to_string(value) + "\n";
}

/// Work groups that cover a side of that many pixels.
constexpr unsigned group_count(int pixels) {
  return (static_cast<unsigned>(pixels) + constant("GROUP_SIZE") - 1) / constant("GROUP_SIZE");
}

}  // namespace umbrameter
