#include "reports/figures/figures.h"

#include <fmt/format.h>

#include <functional>
#include <future>
#include <iterator>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <type_traits>
#include <utility>

#include "core/error.h"
#include "core/parallel.h"
#include "reports/figures/figure_parts.h"
#include "reports/figures/svg_drawing.h"
#include "reports/files/data_folder.h"
#include "reports/files/output.h"
#include "reports/files/png.h"
#include "reports/files/process.h"

namespace umbrameter {
namespace {

namespace fs = std::filesystem;

// Pixels of the PNG for each pixel of the plot.
double plot_zoom(const FigureStyle& style) { return style.is_print() ? style.dpi / 96.0 : 2.0; }

// What became of one figure.
struct Written {
  std::string drawing_problem;
  std::string name_problem;
  std::vector<std::string> file_problems;
};

// A stem becomes a file name: no separators, no leading dot.
bool is_plain_name(const std::string& stem) {
  return !stem.empty() && stem.front() != '.' && stem.find('/') == std::string::npos &&
         stem.find('\0') == std::string::npos;
}

// Writes the file, or notes why it cannot be drawn.
void write_drawn(const fs::path& file, const std::function<std::string()>& draw_bytes, Written& written) {
  std::string bytes;
  try {
    bytes = draw_bytes();
  } catch (const Error& error) {
    written.file_problems.push_back(fmt::format("{} not made: {}", file.string(), error.what()));
    return;
  }
  write_text(file, bytes);
}

// What the files of a figure hold.
struct FigureFiles {
  std::string svg;
  std::string drawing;  ///< SVG that is read once for both of the others
  std::function<std::string(const SvgDrawing&)> to_pdf;
  std::function<std::string(const SvgDrawing&)> to_png;
};

void write_files(const fs::path& folder, const std::string& stem, const FigureFiles& files, Written& written) {
  if (!is_plain_name(stem)) {
    written.name_problem = fmt::format("figure '{}': not a name for a file", stem);
    return;
  }
  write_text(folder / (stem + ".svg"), files.svg);
  std::optional<SvgDrawing> drawing;
  try {
    drawing.emplace(files.drawing);
  } catch (const Error& error) {
    written.file_problems.push_back(
        fmt::format("PDF and PNG of {} not made: {}", (folder / (stem + ".svg")).string(), error.what()));
    return;
  }
  write_drawn(
      folder / (stem + ".pdf"), [&] { return files.to_pdf(*drawing); }, written);
  write_drawn(
      folder / (stem + ".png"), [&] { return files.to_png(*drawing); }, written);
}

Written write_image(const fs::path& folder, const ImageFigure& image, const ErrorImages& errors,
                    const FigureStyle& style) {
  Written written;
  ImageDrawing drawing;
  try {
    const auto error = errors.find(image.stem);
    drawing = draw(image, style, error == errors.end() ? ErrorImage{} : error->second);
  } catch (const Error& error) {
    written.drawing_problem = error.what();
    return written;
  }
  write_files(folder, image.stem,
              {to_svg(drawing), drawing.frame(), [&](const SvgDrawing& frame) { return to_pdf(drawing, frame); },
               [&](const SvgDrawing& frame) { return to_png(drawing, frame); }},
              written);
  return written;
}

struct PlotDrawing {
  std::string stem;
  std::string svg;
};

void write_plot(const fs::path& folder, const PlotDrawing& plot, double zoom, Written& written) {
  write_files(folder, plot.stem,
              {plot.svg, plot.svg, [](const SvgDrawing& drawing) { return drawing.to_pdf(); },
               [&](const SvgDrawing& drawing) { return to_png(drawing.pixels(zoom)); }},
              written);
}

struct PlotDrawings {
  std::vector<PlotDrawing> drawings;
  std::vector<std::string> problems;
};

// All plots in one run of Node: its start takes longer than a plot.
PlotDrawings draw_plots(const std::vector<Figure>& figures, const FigureStyle& style) {
  PlotDrawings result;
  std::string specifications;
  std::vector<std::string> stems;
  const auto add = [&](const auto& plot) {
    if constexpr (!std::is_same_v<decltype(plot), const ImageFigure&>) {
      const std::string specification = to_plot_specification(plot, style);
      specifications += stems.empty() ? '[' : ',';
      specifications += specification;
      stems.push_back(plot.stem);
    }
  };
  for (const Figure& figure : figures) {
    try {
      std::visit(add, figure);
    } catch (const Error& error) {
      result.problems.emplace_back(error.what());
    }
  }
  if (stems.empty()) return result;
  const std::string not_drawn = fmt::format("{} plot{} not drawn", stems.size(), stems.size() == 1 ? "" : "s");
  const fs::path script = data_folder() / "figures.cjs";
  std::error_code error;
  if (!fs::is_regular_file(script, error)) {
    result.problems.push_back(
        fmt::format("{}: {} is missing; set UMBRAMETER_DATA to its folder", not_drawn, script.string()));
    return result;
  }
  const FilterResult drawn = run_filter({"node", script.string()}, specifications + "]");
  if (!drawn.problem.empty()) {
    const bool is_missing = drawn.problem.starts_with("cannot run node:");
    result.problems.push_back(fmt::format("{}: {}{}", not_drawn, drawn.problem, is_missing ? "; install nodejs" : ""));
    return result;
  }
  const nlohmann::json answers = nlohmann::json::parse(drawn.output, nullptr, false);
  if (!answers.is_array() || answers.size() != stems.size()) {
    result.problems.push_back(fmt::format("{}: {} did not respond", not_drawn, script.string()));
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
  for (const Written& one : written) {
    problems.insert(problems.end(), one.file_problems.begin(), one.file_problems.end());
  }
  return problems;
}

}  // namespace

std::vector<std::string> write_figures(const fs::path& folder, const std::vector<Figure>& figures,
                                       const FigureStyle& style, const ErrorImages& errors,
                                       const FigureProgress& progress) {
  std::vector<const ImageFigure*> images;
  for (const Figure& figure : figures) {
    if (const auto* image = std::get_if<ImageFigure>(&figure)) images.push_back(image);
  }
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw Error(ExitCode::partial, "cannot make " + folder.string(), error.message());
  std::mutex mutex;
  std::size_t done = 0;
  const auto count_one = [&] {
    const std::lock_guard lock(mutex);
    if (progress) progress(++done, figures.size());
  };
  // Node takes as long to start as several images take to be written.
  std::future<PlotDrawings> drawn = std::async(std::launch::async, [&] { return draw_plots(figures, style); });
  std::vector<Written> written(images.size());
  parallel_for(images.size(), [&](std::size_t i) {
    written[i] = write_image(folder, *images[i], errors, style);
    count_one();
  });
  PlotDrawings of_plots = drawn.get();
  const double zoom = plot_zoom(style);
  written.resize(images.size() + of_plots.drawings.size());
  parallel_for(of_plots.drawings.size(), [&](std::size_t i) {
    const PlotDrawing& plot = of_plots.drawings[i];
    write_plot(folder, plot, zoom, written[images.size() + i]);
    count_one();
  });
  if (!figures.empty() && !has_fonts()) {
    of_plots.problems.push_back(
        "figures: their PDF and PNG have boxes for letters: no font is installed; install fonts-dejavu-core");
  }
  return collect_problems(written, images.size(), std::move(of_plots.problems));
}

}  // namespace umbrameter
