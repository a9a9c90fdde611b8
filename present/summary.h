// summary.json: the numbers of a run for programs.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "present/axis_ends.h"
#include "present/bias_report.h"
#include "results/layer_description.h"
#include "results/measurement.h"
#include "results/scene_facts.h"

namespace umbrameter {

/// The summary of a sweep's rows.
struct SweepSummary {
  std::size_t cells = 0;
  Table best;  ///< the rows of least error
  /// The cell that the blocks beside "sweep" are about: the values of the axes.
  std::vector<std::pair<std::string, Value>> cell;
  std::optional<BiasCurves> curves{};
  std::vector<OpenEnd> open_ends{};
};

/// Everything that summary.json is made from; empty parts are left out.
struct SummaryInput {
  std::string command;
  Experiment experiment;  ///< as given; a sweep's axes are not applied to it
  SceneFacts scene;
  const Measurement* measurement = nullptr;
  std::optional<SweepSummary> sweep;
  std::vector<NamedLayer> layers{};   ///< of images.exr, in its order
  std::vector<std::string> notes;     ///< every assumption made
  std::string embree;                 ///< version
  std::string gl_renderer;            ///< empty when OpenGL was not used
  std::vector<std::string> files;     ///< written, relative to the output folder
  std::vector<std::string> problems;  ///< what could not be made
};

/// {"m", "texels", "normalised_depth"}; null for one that is not known.
nlohmann::ordered_json to_json(const BiasInUnits& bias);

/// "layers" of summary.json, and an attribute of images.exr.
nlohmann::ordered_json to_json(const std::vector<NamedLayer>& layers);

/// The JSON text. Holds no times or paths, so that equal runs give equal bytes.
std::string to_summary_json(const SummaryInput& input);

}  // namespace umbrameter
