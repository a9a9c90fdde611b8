// The messages of the engine protocol (docs/engine-protocol.md): requests as text, replies checked and as values.
#pragma once

#include <array>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "compare/frame_alignment.h"
#include "core/bounds.h"
#include "experiments/settings/engine_params.h"
#include "scenes/view.h"

namespace umbrameter {

inline constexpr int engine_protocol = 1;

/// What an engine can write.
inline constexpr std::array<std::string_view, 9> engine_outputs = {
    "visibility", "lit", "unshadowed", "ao", "occluded", "open", "position", "depth", "normal"};

struct EngineDescription {
  std::string name;
  std::string version;
  std::string renderer;
  std::vector<std::string> outputs;
  std::vector<std::string> lights;
  std::vector<std::string> cameras;
  DepthConvention depth = DepthConvention::axis;
  std::vector<EngineParameter> parameters;

  bool writes(std::string_view output) const;
  std::string title() const { return version.empty() ? name : name + " " + version; }
};

/// What an adapter loads: the scene's file has one camera and one light, which are repeated here.
struct EngineLoad {
  std::string scene;   ///< path of a .glb
  std::string folder;  ///< for the images
  View view;           ///< with a finite far plane
  Light light;
  Bounds bounds;
};

/// The files that a frame wrote: plain names by output.
struct EngineFrameFiles {
  std::map<std::string, std::string> files;
  double milliseconds = 0.0;  ///< 0: the adapter does not say
  std::vector<std::string> warnings;
};

std::string describe_request(int id);
std::string load_request(int id, const EngineLoad& load);
std::string render_request(int id, const std::vector<std::string>& outputs, std::span<const EngineParams> frames);

/// A reply that keeps to the protocol but says that the request failed.
struct EngineRefusal {
  std::string error;
};

// These throw EngineRefusal, and std::runtime_error with what is wrong with a reply that does not keep to the protocol.
EngineDescription parse_description(std::string_view line, int id);
std::vector<std::string> parse_loaded(std::string_view line, int id);  ///< the warnings
std::vector<EngineFrameFiles> parse_frames(std::string_view line, int id, const std::vector<std::string>& outputs,
                                           std::size_t frames);

}  // namespace umbrameter
