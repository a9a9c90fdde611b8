// The stages of a run with an engine: its frames take the place of what our own rasteriser draws.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "compare/bias_flips.h"
#include "core/error.h"
#include "experiments/settings/engine_bias.h"
#include "experiments/stages/stages.h"
#include "raytrace/frame_causes.h"

namespace umbrameter {
namespace {

// The frames that tell causes apart take at most this, unless one is larger.
constexpr std::size_t most_cause_bytes = std::size_t{64} << 20;

std::string problem_text(const OwnSurfaceFlips& flips) {
  if (flips.problem == FlipProblem::little_acne) {
    return fmt::format("shows acne on less than {:g} % of the lit pixels at its least bias: begin it with less bias",
                       100.0 * least_acne_share);
  }
  if (flips.problem == FlipProblem::too_short) return "ends before two thirds of the acne are lit: extend it";
  return fmt::format("lights more than {:g} % of the acne in one step: give it smaller steps",
                     100.0 * most_own_surface_share);
}

}  // namespace

std::string Stages::renderer() { return options_.frames ? options_.frames->title : context().device().renderer; }

FramedView Stages::framed(const View& view, std::uint32_t light) {
  return {scene_, *scene_content_.get("", [&] { return scene_content(scene_); }), view, scene_.lights[light]};
}

GBuffer Stages::aligned_surfels(const Experiment& experiment, const View& view, GBuffer gbuffer) {
  const std::vector<std::uint32_t> lights = this->lights(experiment.view.light);
  const FrameSource& frames = *options_.frames;
  const std::optional<FrameSurfaces> shown = frames.surfaces(framed(view, lights.front()));
  add_notes(frames.take_warnings());
  if (!shown) {
    add_notes({frames.title +
               " has neither depth nor position: it is taken to show our own surfels, and a shift between both would "
               "count as an error"});
    return gbuffer;
  }
  const FrameAlignment alignment = align_frame(*shown, gbuffer, view);
  if (!alignment.fits()) {
    throw Error(ExitCode::unreadable_input, frames.title, misfit_text(alignment),
                "see 'Proof of alignment' in docs/engine-protocol.md");
  }
  if (alignment.unmatched > 0) {
    add_notes({fmt::format("{}: {:.2g} % of its pixels show another surface than our rays and are left out",
                           frames.title, 100.0 * alignment.share_unmatched())});
  }
  return surfels_of_frame(*shown, gbuffer, view);
}

// Leaves out what the engine does not light even without shadows, because its own normals face away.
CountedPixels Stages::count_lit(const FramedView& framed, const CountPixels& count) {
  const FrameSource& frames = *options_.frames;
  const Image<std::uint8_t> unlit = frames.unlit(framed);
  add_notes(frames.take_warnings());
  const CountedPixels all = count({});
  if (unlit.size() == 0) return all;
  CountedPixels lit = count(unlit);
  const auto pixels_of = [](const CountedPixels& counted) {
    return static_cast<double>(counted.totals[static_cast<std::size_t>(PixelExclusion::none)]);
  };
  const double left_out = pixels_of(all) - pixels_of(lit);
  if (left_out > 0.0) {
    add_notes(
        {fmt::format("{}: {:.2g} % of the pixels that face the light get none there even without shadows and are "
                     "left out",
                     frames.title, 100.0 * left_out / pixels_of(all))});
  }
  return lit;
}

std::vector<FrameShare> Stages::engine_frames(std::span<const Experiment> experiments, std::uint32_t light,
                                              bool is_ao) {
  const FrameSource& frames = *options_.frames;
  if (!(is_ao ? frames.has_ao : frames.has_shadows)) {
    throw Error(ExitCode::usage, frames.title, is_ao ? "it renders no ambient occlusion" : "it renders no shadows",
                is_ao ? "add --measure visibility" : "add --measure ao");
  }
  const auto seen = surfels(experiments.front());
  std::vector<EngineParams> params;
  for (const Experiment& each : experiments) params.push_back(each.engine);
  const FramedView shown = framed(seen->view, light);
  std::vector<FrameShare> shares = is_ao ? frames.ao(shown, params) : frames.visibility(shown, params);
  add_notes(frames.take_warnings());
  const float background = is_ao ? 1.0f : 0.0f;
  for (FrameShare& share : shares) {
    std::uint64_t missing = 0;
    for (std::size_t i = 0; i < share.image.size(); ++i) {
      if (!std::isnan(share.image[i])) continue;
      missing += seen->gbuffer.is_surface(i) ? 1u : 0u;
      share.image[i] = background;
    }
    if (missing == 0) continue;
    throw Error(
        ExitCode::partial, frames.title,
        fmt::format("its {} is NaN at {} pixels that show a surface", is_ao ? "occlusion" : "visibility", missing),
        "it must have a value at every surface");
  }
  return shares;
}

std::vector<Image<float>> Stages::engine_visibility(std::span<const Experiment> experiments, std::uint32_t light) {
  std::vector<FrameShare> shares = engine_frames(experiments, light, false);
  engine_visibility_.keep(shares.size());
  std::vector<Image<float>> images;
  for (std::size_t i = 0; i < shares.size(); ++i) {
    images.push_back(*engine_visibility_.get(key(Stage::visibility, experiments[i], light),
                                             [&] { return std::move(shares[i].image); }));
  }
  return images;
}

double Stages::engine_time(const Experiment& experiment, std::uint32_t light, bool is_ao) {
  const auto start = std::chrono::steady_clock::now();
  const double told = engine_frames({&experiment, 1}, light, is_ao).front().milliseconds;
  const std::chrono::duration<double, std::milli> taken = std::chrono::steady_clock::now() - start;
  return told > 0.0 ? told : taken.count();
}

WrongTaps Stages::causes_of_frame(const Experiment& experiment, std::uint32_t light, const Image<float>& drawn) {
  const auto reference = truth(experiment, light);
  const auto counted = this->counted(experiment, light);
  const Tracer& rays = tracer();
  ProgressBar progress = bar("causes");
  return causes_by_rays(rays, surfels(experiment)->gbuffer, *layout(experiment, light), counted->exclusion,
                        reference->visibility, drawn, progress.callback());
}

std::shared_ptr<const Stages::EngineCauses> Stages::engine_causes(const Experiment& experiment, std::uint32_t light) {
  const std::optional<SweepAxis> axis = engine_bias_axis(experiment);
  if (!axis) return std::make_shared<EngineCauses>();
  Experiment varied = experiment;
  const auto at = [&](std::size_t bias) -> const Experiment& {
    set_value(describe(varied), *axis, axis->values[bias]);
    return varied;
  };
  const std::size_t bytes = surfels(experiment)->gbuffer.position.size() * sizeof(float);
  engine_causes_.keep(std::clamp<std::size_t>(most_cause_bytes / bytes, 1, 64));
  return engine_causes_.get(key(Stage::visibility, at(0), light) + axis->key + "=" + axis->text, [&] {
    const auto frame = [&](std::size_t bias) { return engine_frames({&at(bias), 1}, light, false).front().image; };
    const WrongTaps least = causes_of_frame(at(0), light, frame(0));
    OwnSurfaceFlips flips = find_own_surface_flips(least, counted(experiment, light)->exclusion,
                                                   truth(experiment, light)->visibility, axis->values.size(), frame);
    if (flips.problem == FlipProblem::none) return EngineCauses{"flips over " + axis->key, std::move(flips.visibility)};
    add_notes({fmt::format("rays alone decide the causes, because the axis {} {}", axis->key, problem_text(flips))});
    return EngineCauses{};
  });
}

RasterVisibility Stages::draw_engine(const Experiment& experiment, std::uint32_t light, bool with_truth) {
  const auto visibility = get(engine_visibility_, Stage::visibility, experiment, light, [&](const Experiment& read) {
    return engine_frames({&read, 1}, light, false).front().image;
  });
  RasterVisibility drawn{*visibility, {}};
  const auto seen = surfels(experiment);
  drawn.wrong.weights = Image<uvec4>(seen->gbuffer.width, seen->gbuffer.height, uvec4(0));
  if (!with_truth) return drawn;
  drawn.wrong = causes_of_frame(experiment, light, drawn.visibility);
  const auto causes = engine_causes(experiment, light);
  if (causes->own_surface.size() > 0) separate_too_bright(drawn.wrong, causes->own_surface);
  return drawn;
}

}  // namespace umbrameter
