// The key of the reference cache: everything that a traced reference depends on, as text. References with equal keys
// are bit-identical.
#pragma once

#include <cstdint>
#include <string>

#include "core/gbuffer.h"
#include "scenes/scene.h"
#include "techniques/truth/parameters.h"

namespace umbrameter {

struct ReferenceKey {
  std::string kind;        ///< "visibility" or "ao"
  std::string tracer;      ///< tracer_identity()
  std::string scene;       ///< scene_content()
  std::string surfels;     ///< surfel_content()
  std::string light;       ///< light_content(); empty for AO
  std::string parameters;  ///< all of truth.*, as key_of() writes them
  std::uint32_t seed = 0;
};

/// One line per member.
std::string to_text(const ReferenceKey& key);

/// Hash of everything that rays can hit: triangles, their transforms, and the holes of masked materials. Excludes
/// names, cameras, lights and colours.
std::string scene_content(const Scene& scene);

/// Hash of the surfels, where rays start: image size, ids, positions and normals. Camera, surfel source and driver
/// affect it only through these.
std::string surfel_content(const GBuffer& gbuffer);

/// Hash of a light's kind, position and shape. Excludes its name, colour and intensity.
std::string light_content(const Light& light);

/// Hash of a camera's position, orientation and projection.
std::string camera_content(const Camera& camera);

/// Identifies the tracing code: a hash of this program's file and of the processor's features, and Embree's version.
/// The processor is included because Embree and the mathematics library select code by its features.
std::string tracer_identity();

}  // namespace umbrameter
