#include "reports/figures/figures.h"

#include <fmt/format.h>

#include <future>
#include <iterator>
#include <map>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "core/error.h"
#include "core/parallel.h"
#include "reports/figures/drawing.h"
#include "reports/figures/figure_parts.h"
#include "reports/files/data_folder.h"
#include "reports/files/output.h"
#include "reports/files/process.h"

namespace umbrameter {
namespace {

namespace fs = std::filesystem;

// Plots have no pixels of their own. The converter takes an inch for 96 of its pixels.
std::string plot_zoom(const FigureStyle& style) { return style.is_print() ? fmt::format("{}", style.dpi / 96.0) : "2"; }

// What became of one figure.
struct Written {
  std::string drawing_problem;
  std::string name_problem;
  std::vector<std::string> conversion_problems;
  std::size_t without_program = 0;  ///< files that were not made because rsvg-convert is missing
  std::string missing_program;      ///< which, and what to install
};

// A stem becomes a file name: no separators, no leading dot.
bool is_plain_name(const std::string& stem) {
  return !stem.empty() && stem.front() != '.' && stem.find('/') == std::string::npos &&
         stem.find('\0') == std::string::npos;
}

// The PNG of each frame, drawn once: figures of one size and scale have the same frame, and starting the converter
// takes longer than drawing it.
class Frames {
 public:
  FilterResult png_of(const std::string& svg) {
    std::promise<FilterResult> promise;
    std::shared_future<FilterResult> found;
    bool is_first = false;
    {
      const std::lock_guard lock(mutex_);
      const auto [place, is_new] = drawn_.try_emplace(svg);
      if (is_new) place->second = promise.get_future().share();
      found = place->second;
      is_first = is_new;
    }
    if (!is_first) return found.get();
    try {
      promise.set_value(run_filters({conversion(svg, "png", "1")}, 1).front());
    } catch (...) {
      promise.set_exception(std::current_exception());
    }
    return found.get();
  }

 private:
  std::mutex mutex_;
  std::map<std::string, std::shared_future<FilterResult>> drawn_;
};

// The program's output, or nothing after it noted in `written` why there is none.
std::optional<std::string> checked(const fs::path& file, FilterResult result, Written& written) {
  if (result.problem.empty()) return std::move(result.output);
  const std::string problem = with_package(result.problem, "rsvg-convert", "librsvg2-bin");
  if (problem == result.problem) {
    written.conversion_problems.push_back(fmt::format("{} not made: {}", file.string(), problem));
  } else {
    written.missing_program = problem;
    ++written.without_program;
  }
  return {};
}

std::optional<std::string> convert(const fs::path& file, const std::string& svg, const char* zoom, Written& written) {
  const std::string format = file.extension().string().substr(1);
  return checked(file, run_filters({conversion(svg, format.c_str(), zoom)}, 1).front(), written);
}

// Checks the figure's name; writes the SVG and, from it, the PDF.
bool write_svg_and_pdf(const fs::path& folder, const std::string& stem, const std::string& svg, Written& written) {
  if (!is_plain_name(stem)) {
    written.name_problem = fmt::format("figure '{}': not a name for a file", stem);
    return false;
  }
  write_text(folder / (stem + ".svg"), svg);
  const fs::path pdf = folder / (stem + ".pdf");
  if (const std::optional<std::string> bytes = convert(pdf, svg, "1", written)) write_text(pdf, *bytes);
  return true;
}

Written write_image(const fs::path& folder, const ImageFigure& image, const FigureStyle& style, Frames& frames) {
  Written written;
  ImageDrawing drawing;
  try {
    drawing = draw(image, style);
  } catch (const Error& error) {
    written.drawing_problem = error.what();
    return written;
  }
  if (!write_svg_and_pdf(folder, image.stem, to_svg(drawing), written)) return written;
  const fs::path png = folder / (image.stem + ".png");
  const std::optional<std::string> frame = checked(png, frames.png_of(drawing.frame()), written);
  if (!frame) return written;
  std::string bytes;
  try {
    bytes = to_png(drawing, *frame);
  } catch (const Error& error) {
    written.conversion_problems.push_back(fmt::format("{} not made: {}", png.string(), error.what()));
    return written;
  }
  write_text(png, bytes);
  return written;
}

struct PlotDrawing {
  std::string stem;
  std::string svg;
};

void write_plot(const fs::path& folder, const PlotDrawing& plot, const std::string& zoom, Written& written) {
  if (!write_svg_and_pdf(folder, plot.stem, plot.svg, written)) return;
  const fs::path png = folder / (plot.stem + ".png");
  if (const std::optional<std::string> bytes = convert(png, plot.svg, zoom.c_str(), written)) write_text(png, *bytes);
}

struct PlotDrawings {
  std::vector<PlotDrawing> drawings;
  std::vector<std::string> problems;
};

// All plots in one run of Node: its start takes longer than a plot.
PlotDrawings draw_plots(const Figures& figures, const FigureStyle& style) {
  PlotDrawings result;
  std::string specifications;
  std::vector<std::string> stems;
  const auto add = [&](const auto& plot) {
    try {
      const std::string specification = to_plot_specification(plot, style);
      specifications += stems.empty() ? '[' : ',';
      specifications += specification;
      stems.push_back(plot.stem);
    } catch (const Error& error) {
      result.problems.emplace_back(error.what());
    }
  };
  for (const PlotFigure& plot : figures.plots) add(plot);
  for (const HeatMapFigure& heat_map : figures.heat_maps) add(heat_map);
  for (const WaterfallFigure& waterfall : figures.waterfalls) add(waterfall);
  if (stems.empty()) return result;
  const fs::path script = data_folder() / "figures.cjs";
  std::error_code error;
  if (!fs::is_regular_file(script, error)) {
    result.problems.push_back(fmt::format("{} plots not drawn: {} is missing; set UMBRAMETER_DATA to its folder",
                                          stems.size(), script.string()));
    return result;
  }
  const FilterResult drawn = run_filters({{{"node", script.string()}, {}, specifications + "]"}}, 1).front();
  if (!drawn.problem.empty()) {
    result.problems.push_back(
        fmt::format("{} plots not drawn: {}", stems.size(), with_package(drawn.problem, "node", "nodejs")));
    return result;
  }
  const nlohmann::json answers = nlohmann::json::parse(drawn.output, nullptr, false);
  if (!answers.is_array() || answers.size() != stems.size()) {
    result.problems.push_back(fmt::format("{} plots not drawn: {} did not respond", stems.size(), script.string()));
    return result;
  }
  for (std::size_t i = 0; i < stems.size(); ++i) {
    if (answers[i].contains("svg")) {
      result.drawings.push_back({stems[i], answers[i]["svg"].get<std::string>() + "\n"});
    } else {
      result.problems.push_back(fmt::format("figure {}: {}", stems[i], answers[i].value("error", "not drawn")));
    }
  }
  return result;
}

// In the order in which somebody mends them: figures without a drawing, drawings without files.
std::vector<std::string> collect_problems(const std::vector<Written>& written, std::size_t images,
                                          std::vector<std::string> of_plots) {
  std::vector<std::string> problems;
  for (std::size_t i = 0; i < images; ++i) {
    if (!written[i].drawing_problem.empty()) problems.push_back(written[i].drawing_problem);
  }
  std::move(of_plots.begin(), of_plots.end(), std::back_inserter(problems));
  for (const Written& one : written) {
    if (!one.name_problem.empty()) problems.push_back(one.name_problem);
  }
  std::size_t without_program = 0;
  std::string missing_program;
  for (const Written& one : written) {
    problems.insert(problems.end(), one.conversion_problems.begin(), one.conversion_problems.end());
    without_program += one.without_program;
    if (!one.missing_program.empty()) missing_program = one.missing_program;
  }
  if (without_program > 0) {
    problems.push_back(fmt::format("{} PDF and PNG figures not made: {}", without_program, missing_program));
  }
  return problems;
}

}  // namespace

FigureOutcome write_figures(const fs::path& folder, const Figures& figures, const FigureStyle& style,
                            const FigureProgress& progress) {
  const std::vector<ImageFigure>& images = figures.images;
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw Error(ExitCode::partial, "cannot make " + folder.string(), error.message());
  const std::size_t all = images.size() + figures.plots.size() + figures.heat_maps.size() + figures.waterfalls.size();
  std::mutex mutex;
  std::size_t done = 0;
  const auto count_one = [&] {
    const std::lock_guard lock(mutex);
    if (progress) progress(++done, all);
  };
  // Node takes as long to start as several images take to be written.
  std::future<PlotDrawings> drawn = std::async(std::launch::async, [&] { return draw_plots(figures, style); });
  std::vector<Written> written(images.size());
  Frames frames;
  parallel_for(images.size(), [&](std::size_t i) {
    written[i] = write_image(folder, images[i], style, frames);
    count_one();
  });
  PlotDrawings of_plots = drawn.get();
  const std::string zoom = plot_zoom(style);
  written.resize(images.size() + of_plots.drawings.size());
  parallel_for(of_plots.drawings.size(), [&](std::size_t i) {
    const PlotDrawing& plot = of_plots.drawings[i];
    write_plot(folder, plot, zoom, written[images.size() + i]);
    count_one();
  });
  return {collect_problems(written, images.size(), std::move(of_plots.problems))};
}

}  // namespace umbrameter
