// What a traced reference depends on, as text: equal texts give equal bits. The cache's key.
#pragma once

#include <cstdint>
#include <string>

#include "core/gbuffer.h"
#include "raytrace/parameters.h"
#include "scenes/scene.h"

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

/// One line an ingredient.
std::string to_text(const ReferenceKey& key);

/// What rays can meet: triangles, where they are in the world, and the holes of masked materials; as a hash. Names,
/// cameras, lights and colours do not count.
std::string scene_content(const Scene& scene);

/// Where rays start: size, ids, positions and normals, as a hash. Camera, surfel source and driver count through them.
std::string surfel_content(const GBuffer& gbuffer);

/// Kind, place and form of a light, as a hash. Its name, colour and intensity do not count.
std::string light_content(const Light& light);

/// Place and projection of a camera, as a hash.
std::string camera_content(const Camera& camera);

/// Who traces: a hash of this program's own file and of the processor's abilities, and Embree's version. The processor
/// counts because Embree and the mathematics library choose their code by it.
std::string tracer_identity();

}  // namespace umbrameter
