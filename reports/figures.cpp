#include "reports/figures.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "core/error.h"
#include "core/interrupt.h"
#include "reports/data_folder.h"
#include "reports/drawing.h"
#include "reports/figure_parts.h"
#include "reports/output.h"
#include "reports/process.h"

namespace umbrameter {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t programs_at_once = 2;

struct Drawing {
  std::string stem;
  std::string svg;
  const char* png_zoom;  // plots have no pixels of their own
};

// A stem becomes a file name: no separators, no leading dot.
bool is_plain_name(const std::string& stem) {
  return !stem.empty() && stem.front() != '.' && stem.find('/') == std::string::npos &&
         stem.find('\0') == std::string::npos;
}

void draw_images(const std::vector<ImageFigure>& images, std::vector<Drawing>& drawings, FigureOutcome& outcome) {
  for (const ImageFigure& image : images) {
    throw_if_interrupted();
    try {
      drawings.push_back({image.stem, to_svg(image), "1"});
    } catch (const Error& error) {
      outcome.problems.emplace_back(error.what());
    }
  }
}

// All plots in one run of Node: its start takes longer than a plot.
void draw_plots(const std::vector<PlotFigure>& plots, const std::vector<HeatMapFigure>& heat_maps,
                std::vector<Drawing>& drawings, FigureOutcome& outcome) {
  std::string specifications;
  std::vector<std::string> stems;
  const auto add = [&](const auto& plot) {
    try {
      const std::string specification = to_plot_specification(plot);
      specifications += stems.empty() ? '[' : ',';
      specifications += specification;
      stems.push_back(plot.stem);
    } catch (const Error& error) {
      outcome.problems.emplace_back(error.what());
    }
  };
  for (const PlotFigure& plot : plots) add(plot);
  for (const HeatMapFigure& heat_map : heat_maps) add(heat_map);
  if (stems.empty()) return;
  const fs::path script = data_folder() / "figures.cjs";
  std::error_code error;
  if (!fs::is_regular_file(script, error)) {
    outcome.problems.push_back(fmt::format("{} plots not drawn: {} is missing; set UMBRAMETER_DATA to its folder",
                                           stems.size(), script.string()));
    return;
  }
  const FilterResult result = run_filters({{{"node", script.string()}, {}, specifications + "]"}}, 1).front();
  if (!result.problem.empty()) {
    outcome.problems.push_back(
        fmt::format("{} plots not drawn: {}", stems.size(), with_package(result.problem, "node", "nodejs")));
    return;
  }
  const nlohmann::json answers = nlohmann::json::parse(result.output, nullptr, false);
  if (!answers.is_array() || answers.size() != stems.size()) {
    outcome.problems.push_back(fmt::format("{} plots not drawn: {} gave no answer", stems.size(), script.string()));
    return;
  }
  for (std::size_t i = 0; i < stems.size(); ++i) {
    if (answers[i].contains("svg")) {
      drawings.push_back({stems[i], answers[i]["svg"].get<std::string>() + "\n", "2"});
    } else {
      outcome.problems.push_back(fmt::format("figure {}: {}", stems[i], answers[i].value("error", "not drawn")));
    }
  }
}

void convert(const fs::path& folder, const std::vector<Drawing>& drawings, FigureOutcome& outcome) {
  std::vector<Filter> filters;
  std::vector<fs::path> files;
  for (const Drawing& drawing : drawings) {
    for (const char* format : {"pdf", "png"}) {
      const char* zoom = std::string_view(format) == "png" ? drawing.png_zoom : "1";
      filters.push_back(conversion(drawing.svg, format, zoom));
      files.push_back(folder / (drawing.stem + "." + format));
    }
  }
  const std::vector<FilterResult> results = run_filters(filters, programs_at_once);
  for (std::size_t i = 0; i < files.size(); ++i) {
    if (results[i].problem.empty()) {
      write_text(files[i], results[i].output);
      continue;
    }
    const std::string problem = with_package(results[i].problem, "rsvg-convert", "librsvg2-bin");
    if (problem != results[i].problem) {
      outcome.problems.push_back(fmt::format("{} PDF and PNG figures not made: {}", files.size(), problem));
      return;
    }
    outcome.problems.push_back(fmt::format("{} not made: {}", files[i].string(), problem));
  }
}

}  // namespace

FigureOutcome write_figures(const fs::path& folder, const std::vector<ImageFigure>& images,
                            const std::vector<PlotFigure>& plots, const std::vector<HeatMapFigure>& heat_maps) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw Error(ExitCode::partial, "cannot make " + folder.string(), error.message());
  FigureOutcome outcome;
  std::vector<Drawing> drawings;
  draw_images(images, drawings, outcome);
  draw_plots(plots, heat_maps, drawings, outcome);
  std::erase_if(drawings, [&](const Drawing& drawing) {
    if (is_plain_name(drawing.stem)) return false;
    outcome.problems.push_back(fmt::format("figure '{}': not a name for a file", drawing.stem));
    return true;
  });
  for (const Drawing& drawing : drawings) write_text(folder / (drawing.stem + ".svg"), drawing.svg);
  convert(folder, drawings, outcome);
  return outcome;
}

}  // namespace umbrameter
