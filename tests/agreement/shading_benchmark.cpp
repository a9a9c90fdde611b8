// umbrameter_shading_benchmark [--quick] [--figure DIR]: time of forward and deferred shading for 1 to 256 small lights
// in the courtyard. All ways are run in turn in one process and a ratio is taken within each turn, so that a busy
// machine slows them alike. Times of a software rasteriser are processor times of all threads. Visibility and ambient
// occlusion are 1: no shadow maps. Prints the tables of docs/shading-time.md; --figure writes its figure and numbers.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"
#include "raster/gl/timer.h"
#include "raster/shading/shading_pass.h"
#include "reports/figures/figures.h"
#include "reports/files/data.h"
#include "reports/files/output.h"
#include "scenes/builtin.h"
#include "scenes/view.h"

namespace umbrameter {
namespace {

namespace fs = std::filesystem;

struct Setup {
  int width = 960;
  int height = 540;
  std::size_t most_lights = 256;
  int turns = 3;
  fs::path figure_folder;
};

// The first two lights of courtyard:N surround a camera and reach little that it sees.
constexpr std::size_t skipped_lights = 2;

enum Way : std::size_t { forward, deferred_front, deferred_back, way_count };
constexpr std::array<const char*, way_count> way_names = {"forward", "deferred, front faces", "deferred, back faces"};

using Samples = std::vector<double>;  // one a turn

struct Spread {
  double median = 0.0;
  double least = 0.0;
  double most = 0.0;
};

Spread spread_of(Samples samples) {
  std::sort(samples.begin(), samples.end());
  return {samples[samples.size() / 2], samples.front(), samples.back()};
}

Samples ratios(const Samples& dividends, const Samples& divisors) {
  Samples ratios;
  for (std::size_t i = 0; i < dividends.size(); ++i) ratios.push_back(dividends[i] / divisors[i]);
  return ratios;
}

/// Seconds of the passes before shading.
struct SharedTimes {
  Samples gbuffer;
  Samples store;   ///< the deferred path's formats
  Samples decode;  ///< back into surfels
};

/// Of one number of lights. The deferred path's seconds include storing the G-buffer and the resolve pass.
struct Measured {
  std::size_t lights = 0;
  SharedTimes shared;
  std::array<Samples, way_count> seconds;
  Samples resolve;
  std::array<double, way_count> fragments{};  ///< of light volumes, per pixel
  std::array<double, way_count> in_vain{};    ///< share of these
  std::array<double, way_count> missed{};     ///< share of the pairs of pixel and light that should be shaded
};

struct Drawing {
  const gl::Context& context;
  const UploadedScene& scene;
  const View& view;
  std::vector<LitLight> lights;
  const Image<float>& ao;
};

ShadedImage draw(const Drawing& drawing, Way way, const GpuGBuffer& surfels, const StoredGBuffer& stored,
                 ShadingTimes* times) {
  ShadingParams params;
  params.volume_faces = way == deferred_front ? VolumeFaces::front : VolumeFaces::back;
  if (way == forward) {
    const ForwardInput input{drawing.scene, surfels, drawing.view, params, times};
    return draw_forward(drawing.context, input, drawing.lights, drawing.ao);
  }
  return draw_deferred(drawing.context, {stored, surfels, drawing.view, params, times}, drawing.lights, drawing.ao);
}

void count(Measured& measured, Way way, const ShadedImage& image) {
  double shaded = 0.0, in_vain = 0.0, missed = 0.0;
  for (const LightCounters& counters : image.counters) {
    shaded += counters.shaded;
    in_vain += counters.in_vain;
    missed += counters.missed;
  }
  measured.fragments[way] = shaded / static_cast<double>(image.radiance.size());
  measured.in_vain[way] = in_vain / std::max(shaded, 1.0);
  measured.missed[way] = missed / std::max(shaded - in_vain + missed, 1.0);
}

// What is timed must be the same image, but for the rounding of the stored G-buffer.
void require_same(const Image<vec3>& a, const Image<vec3>& b) {
  double difference = 0.0, sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    difference += std::abs(static_cast<double>(a[i].y - b[i].y));
    sum += static_cast<double>(a[i].y);
  }
  if (difference < 0.02 * sum) return;
  throw Error(ExitCode::check_failed, "shading benchmark", "forward and deferred images differ", "run the tests");
}

void measure_turn(const Drawing& drawing, Measured& measured) {
  const bool is_software = drawing.context.device().software;
  const auto seconds_in = [&](const gl::PassTime& time) { return is_software ? time.processor : time.wall; };
  const auto seconds_of = [&](const auto& work) {
    gl::PassTime time;
    gl::run_timed(&time, work);
    return seconds_in(time);
  };
  GpuGBuffer surfels;
  StoredGBuffer stored;
  const double gbuffer = seconds_of([&] { surfels = draw_gbuffer(drawing.context, drawing.scene, drawing.view); });
  const double store =
      seconds_of([&] { stored = store_gbuffer(drawing.context, surfels, drawing.view, ShadingParams{}); });
  measured.shared.gbuffer.push_back(gbuffer);
  measured.shared.store.push_back(store);
  measured.shared.decode.push_back(seconds_of([&] { decode_surfels(drawing.context, stored, surfels, drawing.view); }));
  Image<vec3> expected;
  for (const Way way : {forward, deferred_front, deferred_back}) {
    ShadingTimes times;
    const ShadedImage image = draw(drawing, way, surfels, stored, &times);
    if (way == forward) expected = image.radiance;
    if (way == deferred_back) require_same(expected, image.radiance);
    measured.seconds[way].push_back(way == forward ? seconds_in(times.lights)
                                                   : store + seconds_in(times.lights) + seconds_in(times.resolve));
    if (way == deferred_back) measured.resolve.push_back(seconds_in(times.resolve));
  }
}

std::vector<Measured> measure(const Setup& setup, const gl::Context& context, const Scene& scene) {
  std::vector<std::string> notes;
  const View view{setup.width, setup.height,
                  select_camera(scene, "", static_cast<double>(setup.width) / setup.height, notes)};
  const UploadedScene uploaded = upload(context, scene);
  const Image<float> ones(setup.width, setup.height, 1.0f);
  std::vector<Measured> all;
  for (std::size_t lights = 1; lights <= setup.most_lights; lights *= 2) {
    Drawing drawing{context, uploaded, view, {}, ones};
    for (std::size_t i = 0; i < lights; ++i) drawing.lights.push_back({&scene.lights.at(skipped_lights + i), &ones});
    Measured& measured = all.emplace_back();
    measured.lights = lights;
    {
      const GpuGBuffer surfels = draw_gbuffer(context, uploaded, view);
      const StoredGBuffer stored = store_gbuffer(context, surfels, view, ShadingParams{});
      for (const Way way : {deferred_front, deferred_back}) {
        count(measured, way, draw(drawing, way, surfels, stored, nullptr));
      }
    }
    if (lights == 1) {  // drivers compile shaders again for each state that they are drawn in
      Measured warm_up;
      measure_turn(drawing, warm_up);
    }
    for (int turn = 0; turn < setup.turns; ++turn) measure_turn(drawing, measured);
  }
  return all;
}

std::string ms(double seconds) {
  return seconds < 0.1 ? fmt::format("{:.2g}", 1e3 * seconds) : fmt::format("{:.0f}", 1e3 * seconds);
}

std::string ms(const Samples& seconds) {
  const Spread spread = spread_of(seconds);
  return fmt::format("{} ({} to {})", ms(spread.median), ms(spread.least), ms(spread.most));
}

std::string ratio(const Samples& dividends, const Samples& divisors) {
  const Spread spread = spread_of(ratios(dividends, divisors));
  return fmt::format("{:.2g} ({:.2g} to {:.2g})", spread.median, spread.least, spread.most);
}

// The tables of docs/shading-time.md.
void print_markdown(const std::vector<Measured>& all) {
  const auto joined = [&](const auto& samples_of) {
    Samples samples;
    for (const Measured& m : all) samples.insert(samples.end(), samples_of(m).begin(), samples_of(m).end());
    return ms(samples);
  };
  fmt::print(
      "| pass | time [ms] |\n| --- | --- |\n| G-buffer | {} |\n| store | {} |\n| decode | {} |\n| resolve | {} |\n",
      joined([](const Measured& m) -> auto& { return m.shared.gbuffer; }),
      joined([](const Measured& m) -> auto& { return m.shared.store; }),
      joined([](const Measured& m) -> auto& { return m.shared.decode; }),
      joined([](const Measured& m) -> auto& { return m.resolve; }));
  fmt::print("\n| lights | forward [ms] | front faces [ms] | back faces [ms] | front / forward | back / forward |\n");
  fmt::print("| --- | --- | --- | --- | --- | --- |\n");
  for (const Measured& m : all) {
    fmt::print("| {} | {} | {} | {} | {} | {} |\n", m.lights, ms(m.seconds[forward]), ms(m.seconds[deferred_front]),
               ms(m.seconds[deferred_back]), ratio(m.seconds[deferred_front], m.seconds[forward]),
               ratio(m.seconds[deferred_back], m.seconds[forward]));
  }
  fmt::print("\n| lights | fragments per pixel, front | back | in vain, front | back |\n");
  fmt::print("| --- | --- | --- | --- | --- |\n");
  for (const Measured& m : all) {
    fmt::print("| {} | {:.2g} | {:.2g} | {:.0f} % | {:.0f} % |\n", m.lights, m.fragments[deferred_front],
               m.fragments[deferred_back], 100.0 * m.in_vain[deferred_front], 100.0 * m.in_vain[deferred_back]);
  }
}

Table to_table(const std::vector<Measured>& all) {
  Table table;
  table.columns = {{"path", "", "forward, or deferred with the drawn faces of the light volumes"},
                   {"lights", "1", "number of lights"},
                   {"seconds", "s", "time of shading, median; deferred: with storing the G-buffer and resolve"},
                   {"relative", "1", "over the time of the G-buffer pass in the same turn, median"},
                   {"relative_least", "1", "least of all turns"},
                   {"relative_most", "1", "most of all turns"},
                   {"fragments", "1", "fragments of light volumes per pixel"},
                   {"in_vain", "1", "share of these outside of the light's volume"},
                   {"missed", "1", "share of the pixels in a light's volume that were not shaded"}};
  for (std::size_t way = 0; way < way_count; ++way) {
    for (const Measured& m : all) {
      const Spread relative = spread_of(ratios(m.seconds[way], m.shared.gbuffer));
      table.rows.push_back({std::string(way_names[way]), static_cast<double>(m.lights),
                            spread_of(m.seconds[way]).median, relative.median, relative.least, relative.most,
                            m.fragments[way], m.in_vain[way], m.missed[way]});
    }
  }
  return table;
}

int write_figure(const fs::path& folder, const Table& table, const Setup& setup) {
  prepare_output_folder(folder);
  PlotFigure figure;
  figure.stem = "shading-time";
  figure.title = "Time of shading / time of the G-buffer pass";
  figure.conditions =
      fmt::format("courtyard, {}×{}, llvmpipe; bands: range of {} turns", setup.width, setup.height, setup.turns);
  figure.x = {"lights", "lights", true};
  figure.y = {"relative", "time / G-buffer pass [1]", true};
  figure.series = "path";
  figure.series_label = "path";
  figure.lower = "relative_least";
  figure.upper = "relative_most";
  figure.data = table;
  write_text(folder / "shading-time.csv", to_csv(table));
  const std::vector<std::string> problems = write_figures(folder, {figure});
  for (const std::string& problem : problems) fmt::print(stderr, "{}\n", problem);
  for (const char* unused : {"shading-time.pdf", "shading-time.png"}) fs::remove(folder / unused);
  return static_cast<int>(problems.empty() ? ExitCode::ok : ExitCode::partial);
}

int run(const Setup& setup) {
  const Scene scene = load_scene("courtyard:258");
  const gl::Context context = gl::Context::make();
  fmt::print(
      "courtyard with 1 to {} small lights, {}x{}, {} turns, {}\n{}\n\n", setup.most_lights, setup.width, setup.height,
      setup.turns, context.device().renderer,
      context.device().software ? "processor time of all threads: median (range)" : "wall-clock time: median (range)");
  const std::vector<Measured> all = measure(setup, context, scene);
  print_markdown(all);
  return setup.figure_folder.empty() ? 0 : write_figure(setup.figure_folder, to_table(all), setup);
}

}  // namespace
}  // namespace umbrameter

int main(int argc, char** argv) {
  umbrameter::Setup setup;
  for (int i = 1; i < argc; ++i) {
    const std::string_view argument = argv[i];
    if (argument == "--quick") {
      setup.width = 96;
      setup.height = 54;
      setup.most_lights = 32;
      setup.turns = 1;
    } else if (argument == "--figure" && i + 1 < argc) {
      setup.figure_folder = argv[++i];
    } else {
      fmt::print(stderr, "usage: umbrameter_shading_benchmark [--quick] [--figure DIR]\n");
      return static_cast<int>(umbrameter::ExitCode::usage);
    }
  }
  try {
    return umbrameter::run(setup);
  } catch (const umbrameter::Error& error) {
    fmt::print(stderr, "{}\n", error.what());
    return static_cast<int>(error.code());
  }
}
