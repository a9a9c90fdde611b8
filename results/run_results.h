// Everything that a run found, as a plain value: the store writes it and reads it, and page, figures, summary.json and
// text are made from it alone.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "results/measurement.h"
#include "results/page_cell.h"
#include "results/scene_facts.h"
#include "results/sweep_bias.h"
#include "results/tune_results.h"

namespace umbrameter {

/// A sweep beside its rows, which stand in the results store.
struct SweepFindings {
  std::string ao_limit{};  ///< distance limit of an ambient-occlusion reference: "up to 58.6 cm"; empty if it is varied
  Table best{};            ///< the row of least error of each line of the figures
  std::optional<BiasCurves> curves{};
  std::vector<PageCell> cells{};  ///< whose images the page has; the first is that of RunResults::measurement
  ViewerPack images{};            ///< theirs, packed as they were measured: all of them at once may need a gigabyte
};

/// The images of one point of a tuning in its first case.
struct TunePointImages {
  std::string name;    ///< "best"
  std::string values;  ///< of the axes, for people
  Measurement measurement;
};

inline constexpr const char* tuned_file = "tuned.toml";  ///< of a tuning: the experiment with the best values

/// The best point in the numbers of engines, in one case.
struct CaseEngines {
  std::string title;  ///< of the case
  std::vector<EngineAdvice> engines{};
  std::string bias{};  ///< which bias they have, if it is not that of the point
};

struct TuneFindings {
  TuneSummary summary;
  std::size_t scenes = 1;
  std::vector<TunePointImages> points{};  ///< empty without figures
  std::vector<CaseEngines> engines{};     ///< for each case, if run.for names any
};

struct RunResults {
  std::string command;               ///< "compare"
  Experiment experiment;             ///< as given, of a tuning that of the first scene; axes are not applied to it
  SceneFacts scene;                  ///< of a tuning the first
  std::string embree;                ///< version
  std::string opengl{};              ///< renderer; empty when OpenGL was not used
  std::string engine{};              ///< "three.js 0.187.0"; empty when our own techniques were measured
  std::vector<std::string> notes{};  ///< every assumption made
  bool full_images = false;          ///< the page gets every pixel of large images, too
  std::optional<Measurement> measurement{};  ///< of a sweep that of the cell of least error; none of a tuning
  std::optional<SweepFindings> sweep{};
  std::optional<TuneFindings> tune{};
};

}  // namespace umbrameter
