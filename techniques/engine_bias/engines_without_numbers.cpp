// Engines whose bias cannot be converted, each with the reason.
#include "techniques/engine_bias/engine.h"

namespace umbrameter {

std::vector<BiasEngine> engines_without_numbers() {
  const auto make = [](std::string_view name, std::string_view title, std::string_view source, std::string_view why) {
    return BiasEngine{.name = name, .title = title, .source = source, .no_numbers = why};
  };
  return {
      make("unity-builtin", "Unity, built-in pipeline", "manual",
           "its source is closed and its unit is not documented"),
      make("o3de", "O3DE", "ProjectedShadowFeatureProcessor.cpp",
           "its formula for directional lights is not verified here"),
      make("ogre-next", "Ogre-Next", "OgreCompositorShadowNodeDef.h, second-hand",
           "a part of its bias follows from the window of the map automatically, and no source is verified here"),
      make("wicked", "Wicked Engine", "wiRenderer.cpp @bc3ef16", "it has a fixed polygon offset and no number for it"),
      make("panda3d", "Panda3D", "shaderGenerator.cxx @c11cb68", "its generated shaders have no bias"),
      make("eevee", "Blender EEVEE", "release notes of 4.2", "since 4.2 it computes its bias automatically"),
      make("bgfx", "bgfx, example 16-shadowmaps", "second-hand",
           "it is an example with a table for each kind of map, not an engine's setting"),
  };
}

}  // namespace umbrameter
