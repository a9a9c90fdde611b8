// umbrameter_scaling DIR [SIZE...] [--quick]: how time and memory of every step grow with the triangles of the built-in
// scenes `forest` (instances) and `city` (nothing shared). Writes DIR/large-scenes.csv and the figures of
// docs/large-scenes.md. A separate process makes and measures each scene of each size. --quick does each step once:
// that shows that the program works, but the times are rough.
#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <exception>
#include <sstream>
#include <string_view>
#include <system_error>

#include "core/error.h"
#include "measure_scene.h"
#include "reports/figures/figures.h"
#include "reports/files/data.h"
#include "reports/files/output.h"
#include "reports/files/process.h"

namespace umbrameter {
namespace {

namespace fs = std::filesystem;

constexpr const char* default_sizes[] = {"100k", "300k", "1M", "3M", "10M", "20M"};
constexpr double large_triangles = 1e6;  // from here on what does not grow with the triangles matters less

void print(const Measurements& measurements) {
  for (const auto& [name, value] : measurements) fmt::print("{}\t{}\n", name, value);
}

Measurements run_self(const std::vector<std::string>& arguments) {
  std::vector<std::string> command = {fs::read_symlink("/proc/self/exe").string()};
  command.insert(command.end(), arguments.begin(), arguments.end());
  const FilterResult result = run_filter(command, {});
  if (!result.problem.empty()) throw Error(ExitCode::partial, arguments.back(), result.problem);
  Measurements measurements;
  std::istringstream lines(result.output);
  std::string name;
  double value = 0.0;
  while (std::getline(lines, name, '\t') && lines >> value >> std::ws) measurements.emplace_back(name, value);
  return measurements;
}

struct Row {
  std::string scene;
  Measurements values;
  double at(std::string_view name) const {
    for (const auto& [key, value] : values) {
      if (key == name) return value;
    }
    throw Error(ExitCode::partial, scene, "nothing was measured under '" + std::string(name) + "'");
  }
};

struct ScratchFile {
  fs::path path;
  ~ScratchFile() {
    std::error_code ignored;
    fs::remove(path, ignored);
  }
};

Row measure(const std::string& scene, const std::string& size, const fs::path& folder, int repeats) {
  const ScratchFile file{folder / fmt::format("{}-{}-{}.glb", scene, size, getpid())};
  Row row{scene, run_self({"--write", scene + ":" + size, file.path.string()})};
  const Measurements measured = run_self({"--measure", file.path.string(), std::to_string(repeats)});
  row.values.insert(row.values.end(), measured.begin(), measured.end());
  fmt::print(stderr, "{}:{}", scene, size);
  for (const auto& [name, value] : row.values) fmt::print(stderr, "  {} {:.4g}", name, value);
  fmt::print(stderr, "\n");
  return row;
}

// Least squares of log y over log x: the exponent of growth.
double slope(const std::vector<std::pair<double, double>>& points) {
  double n = 0.0, sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0;
  for (const auto& [x, y] : points) {
    const double u = std::log(x), v = std::log(y);
    n += 1.0, sx += u, sy += v, sxx += u * u, sxy += u * v;
  }
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

// To two digits: the scenes come close to the number that was asked for.
double rounded(double triangles) {
  const double unit = std::pow(10.0, std::floor(std::log10(triangles)) - 1.0);
  return std::round(triangles / unit) * unit;
}

// A line a name, with its slope over all sizes and over the large ones in the legend.
void add_line(PlotFigure& figure, const std::vector<Row>& rows, const std::string& scene, const std::string& name,
              const std::string& label) {
  std::vector<std::pair<double, double>> points;
  for (const Row& row : rows) {
    if (row.scene == scene) points.emplace_back(rounded(row.at("triangles")), row.at(name));
  }
  std::vector<std::pair<double, double>> large = points;
  std::erase_if(large, [](const auto& point) { return point.first < large_triangles; });
  std::string line = label;
  if (points.size() > 1) line += fmt::format(": {:.2f}", slope(points));
  if (large.size() > 1) line += fmt::format(", {:.2f}", slope(large));
  for (const auto& [x, y] : points) figure.data.rows.push_back({line, x, y});
}

PlotFigure times_figure(const std::vector<Row>& rows, const std::string& scene, const std::string& what) {
  PlotFigure figure;
  figure.stem = "large-scenes-" + scene;
  figure.title = fmt::format("Seconds a step: {}, {}", scene, what);
  figure.caption =
      "1280×720 pixels, shadow map of 2048² texels, software OpenGL. The numbers are slopes on these axes, "
      "over all sizes and from 1 million triangles on: 1 is linear in the triangles.";
  figure.x = {"triangles", "triangles", true};
  figure.y = {"seconds", "time [s]", true};
  figure.series = "step";
  figure.series_label = "step: slope, slope from 1M on";
  figure.data.columns = {{"step", "", ""}, {"triangles", "1", ""}, {"seconds", "s", ""}};
  for (const char* step : step_names) add_line(figure, rows, scene, step, step);
  return figure;
}

PlotFigure memory_figure(const std::vector<Row>& rows) {
  PlotFigure figure;
  figure.stem = "large-scenes-memory";
  figure.title = "Most memory held, by the end of a stage";
  figure.caption = "Resident memory of the whole process; with software OpenGL what the GPU would hold is in it.";
  figure.x = {"triangles", "triangles", true};
  figure.y = {"memory", "memory [MiB]", true};
  figure.series = "stage";
  figure.series_label = "stage: slope, slope from 1M on";
  figure.data.columns = {{"stage", "", ""}, {"triangles", "1", ""}, {"memory", "MiB", ""}};
  for (const char* scene : {"forest", "city"}) {
    for (const char* stage : stage_names) add_line(figure, rows, scene, stage, std::string(scene) + ", " + stage);
  }
  return figure;
}

Table to_table(const std::vector<Row>& rows) {
  Table table;
  table.columns.push_back({"scene", "", "built-in scene"});
  for (const auto& [name, value] : rows.front().values) table.columns.push_back({name, "", name});
  for (const Row& row : rows) {
    std::vector<Value>& cells = table.rows.emplace_back();
    cells.emplace_back(row.scene);
    for (const auto& [name, value] : row.values) cells.emplace_back(value);
  }
  return table;
}

std::string millions(double number) { return fmt::format("{:.3g} M", 1e-6 * number); }

// The table of docs/large-scenes.md.
void print_markdown(const std::vector<Row>& rows) {
  fmt::print("| scene | triangles | stored | instances | load | G-buffer | shadow map | build | primary rays |");
  fmt::print(" shadow rays | peak |\n| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n");
  for (const Row& row : rows) {
    fmt::print("| `{}` | {} | {} | {:.0f} |", row.scene, millions(row.at("triangles")),
               millions(row.at("stored triangles")), row.at("instances"));
    for (const char* step : step_names) fmt::print(" {:.2g} s |", row.at(step));
    fmt::print(" {:.1f} GiB |\n", row.at(stage_names[2]) / 1024.0);
  }
}

int run(const std::vector<std::string>& arguments) {
  if (arguments.size() == 3 && arguments[0] == "--write") {
    print(write_scene(arguments[1], arguments[2]));
    return 0;
  }
  if (arguments.size() == 3 && arguments[0] == "--measure") {
    print(measure_scene(arguments[1], std::stoi(arguments[2])));
    return 0;
  }
  if (arguments.empty() || arguments[0].starts_with("-")) {
    fmt::print(stderr,
               "usage: umbrameter_scaling DIR [SIZE...] [--quick]   sizes as in forest:SIZE, by default 100k to 20M\n");
    return 2;
  }
  const fs::path folder = arguments[0];
  std::vector<std::string> sizes(arguments.begin() + 1, arguments.end());
  const int repeats = std::erase(sizes, "--quick") > 0 ? 1 : 5;
  if (sizes.empty()) sizes.assign(std::begin(default_sizes), std::end(default_sizes));
  prepare_output_folder(folder);
  std::vector<Row> rows;
  for (const char* scene : {"forest", "city"}) {
    for (const std::string& size : sizes) rows.push_back(measure(scene, size, folder, repeats));
  }
  write_text(folder / "large-scenes.csv", to_csv(to_table(rows)));
  const std::vector<PlotFigure> figures = {times_figure(rows, "forest", "instances"),
                                           times_figure(rows, "city", "nothing shared"), memory_figure(rows)};
  const std::vector<std::string> problems = write_figures(folder, {figures.begin(), figures.end()});
  for (const PlotFigure& figure : figures) fs::remove(folder / (figure.stem + ".pdf"));
  print_markdown(rows);
  for (const std::string& problem : problems) fmt::print(stderr, "{}\n", problem);
  return problems.empty() ? 0 : 5;
}

}  // namespace
}  // namespace umbrameter

int main(int argc, char** argv) {
  try {
    return umbrameter::run({argv + 1, argv + argc});
  } catch (const std::exception& error) {
    fmt::print(stderr, "umbrameter_scaling: {}\n", error.what());
    return 1;
  }
}
