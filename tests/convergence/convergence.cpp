// umbrameter_convergence DIR [PIXELS]: error of the reference's ambient occlusion against the closed forms, for both
// samplers and 16 to 4096 rays. Writes DIR/convergence.csv and the figure of docs/reference.md. Each of PIXELS pixels
// a case, 256 by default, has points of its own.
#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <deque>
#include <exception>
#include <string>

#include "core/error.h"
#include "core/quantiles.h"
#include "raytrace/tracer.h"
#include "reports/figures/figures.h"
#include "reports/files/data.h"
#include "reports/files/output.h"
#include "tests/support/ao_cases.h"

namespace umbrameter {
namespace {

namespace fs = std::filesystem;

constexpr int first_rays = 16;
constexpr int last_rays = 4096;

struct Point {
  int rays = 0;
  double error = 0.0;     // RMS over all cases and pixels
  double coverage = 0.0;  // share of pixels whose 95 % interval holds the answer
};

struct Line {
  Sampler sampler;
  std::string name;
  std::vector<Point> points;
};

// What takes longer to make than a few rays to trace, and serves all points.
struct Prepared {
  explicit Prepared(const ao_cases::Case& c) : of(c), scene(ao_cases::scene_of(of)), tracer(scene) {}
  Prepared(const Prepared&) = delete;  // the tracer refers to the scene
  Prepared& operator=(const Prepared&) = delete;

  ao_cases::Case of;
  Scene scene;
  Tracer tracer;
};

Point measure(const std::deque<Prepared>& cases, Sampler sampler, int rays, int pixels) {
  Point point{rays};
  std::size_t count = 0;
  for (const Prepared& c : cases) {
    TruthParams params = ao_cases::params_of(c.of);
    params.sampler = sampler;
    params.spp = rays;
    const TracedAo traced = trace_ao(c.tracer, ao_cases::surfels_of(c.of, pixels), params, 1);
    for (std::size_t i = 0; i < traced.ao.size(); ++i) {
      const double off = traced.ao[i] - c.of.accessibility;
      const double half_width = student_95(traced.degrees_of_freedom) * static_cast<double>(traced.standard_error[i]);
      point.error += off * off;
      point.coverage += std::abs(off) <= half_width ? 1.0 : 0.0;
      ++count;
    }
  }
  point.error = std::sqrt(point.error / static_cast<double>(count));
  point.coverage /= static_cast<double>(count);
  return point;
}

// Of a line through the logarithms, by least squares.
double slope_of(const std::vector<Point>& points) {
  double x_mean = 0.0;
  double y_mean = 0.0;
  for (const Point& p : points) {
    x_mean += std::log(p.rays) / static_cast<double>(points.size());
    y_mean += std::log(p.error) / static_cast<double>(points.size());
  }
  double products = 0.0;
  double squares = 0.0;
  for (const Point& p : points) {
    products += (std::log(p.rays) - x_mean) * (std::log(p.error) - y_mean);
    squares += std::pow(std::log(p.rays) - x_mean, 2);
  }
  return products / squares;
}

// Rays of the line at which its error is that, between its points along straight lines on logarithmic axes.
double rays_for(const std::vector<Point>& points, double error) {
  for (std::size_t i = 1; i < points.size(); ++i) {
    if (points[i].error > error) continue;
    const Point& a = points[i - 1];
    const Point& b = points[i];
    const double t = std::log(a.error / error) / std::log(a.error / b.error);
    return a.rays * std::pow(static_cast<double>(b.rays) / a.rays, t);
  }
  return std::nan("");
}

Table table_of(const std::vector<Line>& lines) {
  Table table{{{"sampler", "", "where the rays go"},
               {"rays", "rays", "of a pixel"},
               {"rmse", "1", "RMS error of accessibility against the closed forms"},
               {"coverage", "1", "share of pixels whose 95 % interval holds the answer"}},
              {}};
  for (const Line& line : lines) {
    for (const Point& p : line.points) {
      table.rows.push_back({line.name, static_cast<std::int64_t>(p.rays), p.error, p.coverage});
    }
  }
  return table;
}

PlotFigure figure_of(const std::vector<Line>& lines, std::size_t cases, double ratio) {
  PlotFigure figure;
  figure.stem = "convergence";
  figure.title = "Error of the reference against its rays";
  figure.caption = fmt::format(
      "RMS error of ambient occlusion against {} closed forms. The number is the slope on these axes. At the error of "
      "1024 random rays, scrambled Sobol points need 1/{:.1f} of them.",
      cases, ratio);
  figure.x = {"rays", "rays a pixel", true};
  figure.y = {"rmse", "RMS error of accessibility [1]", true};
  figure.series = "sampler";
  figure.series_label = "sampler: slope";
  figure.data.columns = {{"sampler", "", ""}, {"rays", "rays", ""}, {"rmse", "1", ""}};
  for (const Line& line : lines) {
    const std::string name = fmt::format("{}: {:.2f}", line.name, slope_of(line.points));
    for (const Point& p : line.points) {
      figure.data.rows.push_back({name, static_cast<std::int64_t>(p.rays), p.error});
    }
  }
  return figure;
}

int run(const std::vector<std::string>& arguments) {
  int pixels = 256;
  if (arguments.empty() || arguments.size() > 2 || arguments[0].starts_with("-") ||
      (arguments.size() == 2 && (pixels = std::atoi(arguments[1].c_str())) < 1)) {
    fmt::print(stderr, "usage: umbrameter_convergence DIR [PIXELS]   PIXELS from 1 on, 256 by default\n");
    return 2;
  }
  const fs::path folder = arguments[0];
  prepare_output_folder(folder);
  std::deque<Prepared> cases;
  for (const ao_cases::Case& c : ao_cases::all()) cases.emplace_back(c);
  std::vector<Line> lines = {{Sampler::owen, "owen", {}}, {Sampler::random, "random", {}}};
  for (Line& line : lines) {
    for (int rays = first_rays; rays <= last_rays; rays *= 2) {
      line.points.push_back(measure(cases, line.sampler, rays, pixels));
      const Point& p = line.points.back();
      fmt::print("{:<7} {:5} rays: RMSE {:.6f}, interval holds {:.1f} %\n", line.name, p.rays, p.error,
                 100.0 * p.coverage);
    }
  }
  double random_1024 = 0.0;
  for (const Point& p : lines[1].points) random_1024 = p.rays == 1024 ? p.error : random_1024;
  const double ratio = 1024.0 / rays_for(lines[0].points, random_1024);
  fmt::print("at the error of 1024 random rays, owen needs 1/{:.2f} of them\n", ratio);
  write_text(folder / "convergence.csv", to_csv(table_of(lines)));
  const std::vector<std::string> problems = write_figures(folder, {figure_of(lines, cases.size(), ratio)});
  for (const std::string& problem : problems) fmt::print(stderr, "{}\n", problem);
  return problems.empty() ? 0 : 5;
}

}  // namespace
}  // namespace umbrameter

int main(int argc, char** argv) {
  try {
    return umbrameter::run({argv + 1, argv + argc});
  } catch (const std::exception& error) {
    fmt::print(stderr, "umbrameter_convergence: {}\n", error.what());
    return 1;
  }
}
