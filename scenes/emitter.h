// The extent of lights: what a file or the light.* parameters say of it, and what may be said.
// How it is sampled is the tracer's business.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "core/parameters.h"
#include "scenes/scene.h"

namespace umbrameter {

/// What a radius makes of a light; usual: a sphere of a point light, a disk of a spot light.
enum class EmitterShape : int { usual, sphere, disk };

/// The light.* parameters: the extent of the measured lights. A value below 0 leaves what the scene says, 0 makes the
/// light a point or a direction. A shape without a radius is that of the radius which the scene gives.
struct LightParams {
  double radius = -1.0;
  double width = -1.0;
  double height = -1.0;
  double angle = -1.0;  ///< degrees
  EmitterShape shape = EmitterShape::usual;
};
Parameters describe(LightParams& params);

/// What is given of an extent, in the terms of a file; nothing for what is not given.
struct EmitterSizes {
  std::optional<double> radius;            ///< metres
  std::optional<double> width;             ///< metres
  std::optional<double> height;            ///< metres
  std::optional<double> angular_diameter;  ///< radians
  EmitterShape shape = EmitterShape::usual;

  bool has_lengths() const { return radius || width || height; }
};

/// Why such sizes cannot be, or empty: below 0 or too large, a radius and sides at once, one side without the other.
std::string objection(const EmitterSizes& sizes);

/// The emitter of a light of that kind: directional lights heed the angle alone, the others lengths alone; nothing
/// when those are not given or 0. The sizes must be free of objections.
Emitter make_emitter(const Light& light, const EmitterSizes& sizes);

/// Whether the light has extent, so that its visibility is a share that must be sampled.
bool is_area(const Light& light);

/// Half the size of a light, as techniques for soft shadows take it: the radius in metres (of a rectangle: that of the
/// disk with its area), of a distant disk the tangent of its angular radius; 0 without extent.
double half_size(const Emitter& emitter);

/// The light with the extent that the parameters give it.
Light with_extent(Light light, const LightParams& params);

/// Throws Error (usage) for sizes that cannot be, and for a size or a shape that none of the lights heeds.
void require_sense(const LightParams& params, std::span<const Light> lights);

/// "sphere", "disk", "rectangle", "distant disk"; empty without extent.
const char* kind_of(const Emitter& emitter);

}  // namespace umbrameter
