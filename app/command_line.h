// The command line as data. The only door to the command-line parser.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "core/error.h"
#include "experiments/engine/engine.h"
#include "reports/figures/style.h"

namespace umbrameter {

/// What `diff` compares and how; texts as given.
struct DiffOptions {
  std::filesystem::path test;
  std::filesystem::path reference;
  std::string layer;
  std::string reference_layer;  ///< empty: the same
  std::string metrics;          ///< comma-separated; empty for all
  std::string map;              ///< metric whose map is written; empty for FLIP
  std::filesystem::path mask;
  std::string crop;  ///< "X,Y,WIDTH,HEIGHT"
  bool data = false;
  double pixels_per_degree = 0.0;  ///< 0: default
  double exposure = 0.0;           ///< [EV]
  std::string exposures;           ///< "START:STOP[:COUNT]"
  bool exit_code = false;
};

/// What `check` holds against what.
struct CheckOptions {
  std::vector<std::filesystem::path> folders;  ///< finished runs
  std::filesystem::path budget;
  std::filesystem::path junit;    ///< JUnit XML to write; empty for none
  std::filesystem::path summary;  ///< Markdown to append to; empty for none
  bool update = false;
};

/// What `tune` varies, minimises and goes over; texts as given.
struct TuneOptions {
  std::vector<std::string> scenes;
  std::string minimize = "mae";
  std::vector<std::string> constraints;
  std::vector<std::string> over;      ///< "view.camera=all"
  std::vector<std::string> held_out;  ///< "view.camera=1", "scene=forest"
  bool worst_case = false;
  bool relative = false;
  std::size_t evaluations = 0;  ///< 0: by the number of axes
  double minutes = 0.0;         ///< 0: no limit
};

/// What `report` reads.
struct ReportOptions {
  std::vector<std::filesystem::path> folders;  ///< finished runs; the first is what the others are compared with
  bool latex = false;
};

/// What `convert` converts; texts as given.
struct ConvertOptions {
  std::string from;             ///< "godot:bias=0.1,normal_bias=2"
  std::vector<std::string> to;  ///< "three,unity-urp"; empty for all
};

/// Of `plan`, `run`, `merge` and `status`.
struct PlanOptions {
  std::string planned;           ///< command that is cut: "sweep" or "tune"
  std::filesystem::path folder;  ///< of the plan
  std::size_t shards = 0;        ///< number of shards; 0: by one of the two below
  std::size_t cells_per_shard = 0;
  double minutes_per_shard = 0.0;
  std::size_t points_per_round = 0;  ///< of a tuning; 0: as many as the shards measure at once
  bool by_reference = false;         ///< the scene stays where it is
  bool commands = false;             ///< print commands, one a line
  std::string shard;                 ///< "3,7-9" or "env"
  bool partial = false;
};

struct CommandLine {
  std::string command;  ///< the subcommand
  std::string scene;    ///< file or name of a built-in scene; empty when not given
  std::filesystem::path output;
  std::filesystem::path experiment_file;
  std::vector<std::string> presets;
  std::vector<std::pair<std::string, std::string>> settings;  ///< full parameter name, text, in order
  std::vector<std::string> vary;                              ///< "name=axis"
  std::shared_ptr<Engine> engine;  ///< that --engine or the experiment file names; null: our own techniques
  std::string action;              ///< of `engine`: "list", "check" or "serve"
  std::string gl_device;
  int threads = 0;
  std::string memory;  ///< what the contents of a file may take, "8G"; empty for the usual limit
  bool quiet = false;
  bool verbose = false;
  bool json = false;
  bool markdown = false;
  bool no_figures = false;         ///< no figures/ folder, and a page without pictures
  bool full_images = false;        ///< the page holds every pixel of large images
  std::size_t page_cells = 6;      ///< of a sweep: cells whose images the page has
  bool no_cache = false;           ///< references are traced again and not kept
  bool force = false;              ///< an earlier run's results in the folder are replaced
  bool dry_run = false;            ///< show what would be measured, write nothing
  bool clear = false;              ///< empty the cache of references
  std::vector<std::string> names;  ///< of built-in scenes to list or draw; empty for all
  std::filesystem::path sheet;     ///< contact sheet to draw; empty for none
  std::string tile_size;           ///< of each picture on it, "WxH"; empty for the usual one
  bool measure_memory = false;
  FigureOptions figures;
  DiffOptions diff;
  CheckOptions check;
  TuneOptions tune;
  ReportOptions report;
  ConvertOptions convert;
  PlanOptions plan;
  std::vector<std::string> fail_if;  ///< conditions under which compare ends with exit code 1
};

/// Help, version or a generated file, to print or to write.
struct Information {
  std::string text;
  std::filesystem::path file{};  ///< empty: stdout, or stderr where the code is not ok
  ExitCode code = ExitCode::ok;
};

/// Throws Error (usage) with one line for anything that is not understood.
std::variant<CommandLine, Information> parse_command_line(int argc, const char* const* argv);

}  // namespace umbrameter
