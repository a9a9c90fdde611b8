// summary.json: the numbers of a run for programs.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "present/axis_ends.h"
#include "results/layer_description.h"
#include "results/run_results.h"

namespace umbrameter {

/// What the rows of a sweep say besides its findings.
struct SweepSummary {
  std::size_t cells = 0;
  std::vector<std::pair<std::string, Value>> least;  ///< the cell of least error: the values of the axes
  std::vector<OpenEnd> open_ends{};
};

/// {"m", "texels", "normalised_depth"}; null for one that is not known.
nlohmann::ordered_json to_json(const BiasInUnits& bias);

/// "layers" of summary.json, and an attribute of images.exr.
nlohmann::ordered_json to_json(const std::vector<NamedLayer>& layers);

/// The JSON text; `files` are those written, relative to the output folder, `problems` what could not be made. Holds no
/// times or paths, so that equal runs give equal bytes.
std::string to_summary_json(const RunResults& results, const std::optional<SweepSummary>& sweep,
                            const std::vector<std::string>& files, const std::vector<std::string>& problems);

}  // namespace umbrameter
