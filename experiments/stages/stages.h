// Runs the stages of one scene on demand. The last result of each stage is kept, with the values of the parameters that
// it depends on (stage_inputs.h), so that the cells of a sweep share results. Callers share ownership of a result: it
// stays valid and unchanged while they hold its pointer, whichever stages run meanwhile. What is on the GPU must not
// outlive the Stages.
//
// Lengths of ambient occlusion are in metres here: convert an experiment once, by Stages::in_metres(), where it comes
// in. Stages that read such a length throw Error (usage) if it has another unit.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <functional>
#include <future>
#include <list>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "compare/unresolved_taps.h"
#include "compare/visibility.h"
#include "experiments/engine/frame_source.h"
#include "experiments/settings/experiment.h"
#include "experiments/settings/stage_inputs.h"
#include "experiments/stages/costs.h"
#include "experiments/stages/reference_cache.h"
#include "experiments/stages/stage_clock.h"
#include "raster/rasterizer.h"
#include "raster/shading/shading_pass.h"
#include "raytrace/tracer.h"
#include "reports/files/console.h"
#include "results/measurement.h"
#include "results/scene_facts.h"
#include "scenes/scene.h"
#include "techniques/shadow/cascades.h"
#include "techniques/shadow/map_layout.h"

namespace umbrameter {

/// Throws Error (usage) if the light.* parameters, or those of cascades, make no sense for these lights.
void require_sense(const Experiment& experiment, std::span<const Light> lights);

/// The last computed values and their keys; one, unless keep() allows more. A value that gives way to a newer one lives
/// on while someone holds it.
template <class T>
class Memo {
 public:
  Memo() = default;
  /// Charges what making a value takes to a stage.
  Memo(StageClock& clock, Stage stage) : clock_(&clock), stage_(stage) {}

  void keep(std::size_t values) { most_ = values; }

  std::shared_ptr<const T> get(const std::string& key, const std::function<T()>& make) {
    return remake(key, [&](std::optional<T> last) {
      last.reset();
      return make();
    });
  }

  /// make() receives the oldest value, if that has to give way and nobody else holds it, and may reuse its parts.
  std::shared_ptr<const T> remake(const std::string& key, const std::function<T(std::optional<T>)>& make) {
    const auto found = std::ranges::find(kept_, key, &Kept::key);
    if (found != kept_.end()) {
      kept_.splice(kept_.begin(), kept_, found);
      return kept_.front().value;
    }
    std::optional<StageClock::Running> running;
    if (clock_ != nullptr) running.emplace(*clock_, stage_);
    std::optional<T> oldest;
    while (kept_.size() >= most_) {
      oldest.reset();
      if (kept_.back().value.use_count() == 1) oldest.emplace(std::move(*kept_.back().value));
      kept_.pop_back();
    }
    kept_.push_front({key, std::make_shared<T>(make(std::move(oldest)))});
    return kept_.front().value;
  }

 private:
  struct Kept {
    std::string key;
    std::shared_ptr<T> value;
  };
  StageClock* clock_ = nullptr;
  Stage stage_{};
  std::list<Kept> kept_;  // the newest first
  std::size_t most_ = 1;
};

/// A reference of ambient occlusion that another thread traces. The destructor cancels it and waits.
struct AoInBackground {
  std::string key;
  std::atomic<double> share{0.0};  ///< share that is done, 0 to 1
  std::atomic<bool> is_cancelled{false};
  std::future<TracedAo> traced{};

  ~AoInBackground();
};

/// Which results a command needs. The difference is computed if both are needed.
struct Sides {
  bool raster = true;
  bool truth = true;
};

/// The deferred path's G-buffer, and the surfels decoded from it, on the GPU and in memory.
struct StoredSurfels {
  StoredGBuffer stored;
  GpuGBuffer gpu;
  GBuffer gbuffer;
};

/// The surfels that the technique shades. Forward path: the exact ones. Deferred path: those decoded from its G-buffer.
struct ShadingSurfels {
  std::shared_ptr<const GpuGBuffer> gpu;
  std::shared_ptr<const GBuffer> gbuffer;
  bool is_exact = true;
};

/// A look-up, and the results of stages that it refers to.
struct HeldLookup {
  ShadowLookup lookup;
  std::array<std::shared_ptr<const void>, 5> results;
};

struct StageOptions {
  std::string gl_device;
  int threads = 0;
  std::optional<CacheFolder> cache{};  ///< for references
  std::string source{};                ///< the scene's file or built-in name, for messages
  /// The GL context, current on the calling thread. If empty, Stages creates one.
  std::shared_ptr<gl::Context> context{};
  /// Another renderer, whose frames take the place of what our own techniques draw; no OpenGL is used then.
  std::shared_ptr<const FrameSource> frames{};
};

class Stages {
 public:
  /// If the scene has no lights, adds a sun and a note.
  Stages(Scene scene, StageOptions options, const Console& console);

  const Scene& scene() const { return scene_; }
  /// Of the scene without its ground.
  const Bounds& bounds() const { return bounds_.scene; }
  const MappedBounds& mapped_bounds() const { return bounds_; }
  /// in_metres() with the size of this scene.
  Experiment in_metres(const Experiment& experiment) const;
  /// Of the scene with the light that was added.
  const SceneFacts& facts() const { return facts_; }
  const std::string& layer(std::uint32_t light) const { return facts_.layer(light); }
  const std::string& title(std::uint32_t light) const { return facts_.title(light); }
  /// The light with the extent that the experiment gives it; without extent if truth.shadow is point.
  Light light(const Experiment& experiment, std::uint32_t light) const;
  /// Whether the reference of the light's shadow is sampled and takes values between 0 and 1, so that it has no causes.
  bool is_sampled(const Experiment& experiment, std::uint32_t light) const {
    return reference_stage(experiment, light) != Stage::binary_reference;
  }
  /// require_sense() for these lights.
  void check_is_meaningful(const Experiment& experiment, const std::vector<std::uint32_t>& lights) const;
  /// Indices of the lights that a name or index selects; all when empty.
  std::vector<std::uint32_t> lights(const std::string& name_or_index) const;

  const Tracer& tracer();
  const gl::Context& context();
  const UploadedScene& uploaded();

  std::shared_ptr<const Surfels> surfels(const Experiment& experiment);
  std::shared_ptr<const GpuGBuffer> gpu_surfels(const Experiment& experiment);
  std::shared_ptr<const MapLayout> layout(const Experiment& experiment, std::uint32_t light);
  std::shared_ptr<const CountedPixels> counted(const Experiment& experiment, std::uint32_t light);
  ShadowMapImages read_map(const Experiment& experiment, std::uint32_t light);
  /// The values that a filtered map holds: for each view the same number of layers, one after the other; none if the
  /// technique has no such map.
  std::vector<Image<vec4>> read_filtered_map(const Experiment& experiment, std::uint32_t light);

  /// Whether another renderer takes the place of our own techniques.
  bool has_engine() const { return options_.frames != nullptr; }
  /// Time of a frame of the engine, by its own clock where it tells, milliseconds.
  double engine_time(const Experiment& experiment, std::uint32_t light, bool is_ao);
  /// What draws: the other renderer, or the OpenGL device.
  std::string renderer();
  /// Capabilities of the experiment's technique. The error of an engine has causes as well: rays find them.
  TechniqueCapabilities capabilities(const Experiment& experiment) const {
    if (has_engine()) return {.sums_comparisons = true};
    return capabilities_of(make_technique(experiment.shadow));
  }

  /// How the causes of an engine's errors are found, and the frame that separate_too_bright() needs.
  struct EngineCauses {
    std::string source = "rays";  ///< or "flips over engine.bias"
    Image<float> own_surface{};   ///< empty: rays alone
  };
  /// In a sweep over one bias of the engine flips help the rays, if its frames suffice, else a note says why not. The
  /// frames are drawn for that, whatever cells the sweep has measured: a cell does not depend on where it resumed.
  std::shared_ptr<const EngineCauses> engine_causes(const Experiment& experiment, std::uint32_t light);

  std::shared_ptr<const TracedVisibility> truth(const Experiment& experiment, std::uint32_t light);
  /// The hard shadow: from each pixel's centre to the light's centre. It is truth() where that is not sampled. Its
  /// edges are the shadow edges of the statistics; those of a sampled reference would depend on the number of rays.
  std::shared_ptr<const TracedVisibility> hard_truth(const Experiment& experiment, std::uint32_t light);
  std::shared_ptr<const TracedAo> ao_truth(const Experiment& experiment);
  /// Starts tracing on another thread; ao_truth() for the same experiment waits for the result.
  void begin_ao_truth(const Experiment& experiment);
  /// If with_truth, also classifies wrong taps by the two-plane rule.
  RasterVisibility draw(const Experiment& experiment, std::uint32_t light, bool with_truth);
  /// Tests with rays the taps that the two-plane rule calls false occlusion, and moves those on the receiver's surface
  /// to acne in `wrong`, the result of draw() for the same experiment.
  ClassAgreement reclassify(const Experiment& experiment, std::uint32_t light, WrongTaps& wrong);
  /// The error at every bias of the axes, which replace the experiment's biases. Classifies taps by run.classes.
  BiasHistogram bias_response(const Experiment& experiment, std::uint32_t light, const BiasAxes& axes);
  /// Where the tap of each pixel flips, for a technique with one tap per pixel. Classifies taps by run.classes.
  TapFlips tap_flips(const Experiment& experiment, std::uint32_t light, const BiasAxes& axes);
  /// The visibility of experiments that differ only in lookup_parameters(), at most max_lookups, in one pass; of an
  /// engine's, in engine.*, in one request.
  /// They are kept for draw() until the next call.
  std::vector<Image<float>> draw_lookups(std::span<const Experiment> experiments, std::uint32_t light);
  Image<float> draw_ao(const Experiment& experiment);
  /// The samples of hemisphere SSAO that occlude at the axes' first bias or more. The axes replace the experiment's
  /// bias and number of samples.
  void draw_ao_response(const Experiment& experiment, const AoAxes& axes, const AoResponseSink& sink);

  /// What the technique of ambient occlusion reads of surfels().
  AoSurfelImages read_ao_surfels(const Experiment& experiment);

  ShadingSurfels shading_surfels(const Experiment& experiment);
  /// The technique's results at these surfels instead of surfels().
  Image<float> draw_visibility_of(const GpuGBuffer& surfels, const Experiment& experiment, std::uint32_t light);
  Image<float> draw_ao_of(const GpuGBuffer& surfels, const Experiment& experiment);
  /// The technique's image, by the path of the experiment.
  ShadedImage shade(const Experiment& experiment, std::span<const LitLight> lights, const Image<float>& ao);
  /// The light's shadow map.
  std::shared_ptr<const ShadowMap> map(const Experiment& experiment, std::uint32_t light);
  /// What the light's shadow map can store.
  std::shared_ptr<const StoredDepths> stored_depths(const Experiment& experiment, std::uint32_t light);

  /// From now on keeps the surfels, references and, if with_maps, shadow maps of this many views and lights, for
  /// commands that go round them.
  void keep_cases(std::size_t cases, bool with_maps);

  /// Reports the progress of tracing to `to`, for a bar that covers several stages; the stages then show no bars. If
  /// `to` is empty, each stage shows its bar again.
  void report_tracing(Progress to) { tracing_ = std::move(to); }

  /// Tells how long the stages work: processor time, unless a GPU or an engine does some of it.
  WorkClock work_clock();
  /// What the stages take by work_clock() while `work` runs, which is `rest` otherwise.
  GroupTime time_stages(const std::function<void()>& work);
  /// Costs of tracing so far.
  const Costs& costs() const { return costs_; }
  /// Every assumption made so far, each once.
  const std::vector<std::string>& notes() const { return notes_; }
  /// Adds and prints those notes that are new.
  void add_notes(const std::vector<std::string>& notes);

 private:
  using TestedTaps = std::function<void(std::span<const UnresolvedTap>, std::span<const std::uint8_t>)>;
  void test_unresolved_taps(const Experiment& experiment, std::uint32_t light, const BiasAxes& axes, bool of_lit,
                            const TestedTaps& take);
  FramedView framed(const View& view, std::uint32_t light);
  using CountPixels = std::function<CountedPixels(const Image<std::uint8_t>& unlit)>;
  CountedPixels count_lit(const FramedView& framed, const CountPixels& count);
  GBuffer aligned_surfels(const Experiment& experiment, const View& view, GBuffer gbuffer);
  std::vector<FrameShare> engine_frames(std::span<const Experiment> experiments, std::uint32_t light, bool is_ao);
  std::vector<Image<float>> engine_visibility(std::span<const Experiment> experiments, std::uint32_t light);
  WrongTaps causes_of_frame(const Experiment& experiment, std::uint32_t light, const Image<float>& drawn);
  RasterVisibility draw_engine(const Experiment& experiment, std::uint32_t light, bool with_truth);
  HeldLookup shadow_lookup(const Experiment& experiment, std::uint32_t light, bool with_truth);
  std::shared_ptr<const StoredSurfels> stored_surfels(const Experiment& experiment);
  ProgressBar bar(const char* stage) const;
  ProgressBar tracing_bar(const char* stage, std::function<std::uint64_t()> count_rays) const;
  ReferenceKey reference_key(const Experiment& experiment, Stage stage, const std::string& kind);
  std::string key(Stage stage, const Experiment& experiment, std::uint32_t light) const;
  /// The stage's result from a memo, or made of what the stage declares, which is all that `make` should read.
  template <class T, class Make>
  std::shared_ptr<const T> get(Memo<T>& memo, Stage stage, const Experiment& experiment, const Make& make) {
    return memo.get(key_of(stage, experiment), [&]() -> T { return make(declared(stage, experiment)); });
  }
  template <class T, class Make>
  std::shared_ptr<const T> get(Memo<T>& memo, Stage stage, const Experiment& experiment, std::uint32_t light,
                               const Make& make) {
    return memo.get(key(stage, experiment, light), [&]() -> T { return make(declared(stage, experiment)); });
  }
  Stage reference_stage(const Experiment& experiment, std::uint32_t light) const;
  TracedVisibility trace(const Experiment& experiment, Stage reference, std::uint32_t light);

  Scene scene_;
  StageOptions options_;
  Console console_;
  Progress tracing_;
  MappedBounds bounds_;
  SceneFacts facts_;
  std::vector<std::string> notes_;
  ReferenceCache cache_;
  Costs costs_;
  std::optional<Tracer> tracer_;
  // Before all members that hold GPU objects, so that these are destroyed before their context.
  std::shared_ptr<gl::Context> context_;
  std::unique_ptr<UploadedScene> uploaded_;
  std::unique_ptr<StageClock> clock_ = std::make_unique<StageClock>();  // Memos point to it when Stages moves
  Memo<Surfels> surfels_{*clock_, Stage::surfels};
  Memo<GpuGBuffer> gpu_surfels_{*clock_, Stage::surfels};
  Memo<StoredSurfels> stored_surfels_{*clock_, Stage::stored_gbuffer};
  Memo<MapLayout> layout_{*clock_, Stage::layout};
  Memo<CountedPixels> counted_{*clock_, Stage::counted};
  Memo<ShadowMap> map_{*clock_, Stage::map};
  Memo<StoredDepths> stored_depths_;
  Memo<TechniqueMap> filtered_map_{*clock_, Stage::filtered_map};
  Memo<Image<float>> ao_{*clock_, Stage::ao};
  Memo<Image<float>> engine_visibility_{*clock_, Stage::visibility};
  Memo<EngineCauses> engine_causes_;
  Memo<TracedVisibility> hard_truth_{*clock_, Stage::binary_reference};
  Memo<TracedVisibility> sampled_truth_{*clock_, Stage::area_reference};
  Memo<gl::Texture> gpu_truth_{*clock_, Stage::counted};
  Memo<TracedAo> ao_truth_{*clock_, Stage::ao_reference};
  Memo<std::string> tracer_identity_;
  Memo<std::string> scene_content_;
  Memo<std::string> surfel_content_;
  // The last member, destroyed first: its thread reads the tracer until it ends.
  std::unique_ptr<AoInBackground> ao_in_background_;
};

}  // namespace umbrameter
