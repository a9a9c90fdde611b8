// The stages of a run over one scene, each at its first use. The last result of a stage is kept under the parameters
// that it depends on (stage_inputs.h), so that the cells of a sweep share what they have in common.
#pragma once

#include <atomic>
#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "compare/unresolved_taps.h"
#include "compare/visibility.h"
#include "experiments/console.h"
#include "experiments/costs.h"
#include "experiments/experiment.h"
#include "experiments/reference_cache.h"
#include "experiments/stage_inputs.h"
#include "raster/rasterizer.h"
#include "raytrace/tracer.h"
#include "scenes/scene.h"
#include "techniques/shadow/map_layout.h"

namespace umbrameter {

/// The last value made, and the key that it was made for.
template <class T>
class Memo {
 public:
  const T& get(const std::string& key, const std::function<T()>& make) {
    return remake(key, [&](std::optional<T> last) {
      last.reset();
      return make();
    });
  }

  /// make() receives the last value, whose parts it can use again.
  const T& remake(const std::string& key, const std::function<T(std::optional<T>)>& make) {
    if (!value_ || key != key_) {
      std::optional<T> last = std::exchange(value_, std::nullopt);
      value_.emplace(make(std::move(last)));
      key_ = key;
    }
    return *value_;
  }

 private:
  std::string key_;
  std::optional<T> value_;
};

/// The surfels of a view, for both sides.
struct Surfels {
  View view;
  GBuffer gbuffer;
};

/// A reference that is being traced on another thread; ends it when it goes.
struct AoInBackground {
  std::string key;
  std::atomic<double> share{0.0};  ///< done, 0 to 1
  std::atomic<bool> is_cancelled{false};
  std::future<TracedAo> traced{};

  ~AoInBackground();
};

struct StageOptions {
  std::string gl_device;
  int threads = 0;
  std::optional<CacheFolder> cache{};  ///< for references
  std::string source{};                ///< the scene's file or built-in name, for messages
  /// Where to draw; one is made where there is none. It must be current on the calling thread.
  std::shared_ptr<gl::Context> context{};
};

class Stages {
 public:
  /// A scene without lights is given a sun, with a note.
  Stages(Scene scene, StageOptions options, const Console& console);

  const Scene& scene() const { return scene_; }
  const Bounds& bounds() const { return bounds_; }
  /// The experiment with its lengths in metres of this scene: in_metres().
  Experiment in_metres(const Experiment& experiment) const;
  const std::string& layer(std::uint32_t light) const { return layers_[light]; }
  /// For people: the light's name, "light 2" where it has none, "lamp (2)" where several have it.
  std::string title(std::uint32_t light) const;
  /// The light with the extent that the experiment gives it.
  Light light(const Experiment& experiment, std::uint32_t light) const;
  /// Throws Error (usage) where the light.* parameters make no sense for these lights.
  void require_sense_for(const Experiment& experiment, const std::vector<std::uint32_t>& lights) const;
  /// Indices of the lights that a name or index selects; all when empty.
  std::vector<std::uint32_t> lights(const std::string& name_or_index) const;

  const Tracer& tracer();
  const gl::Context& context();
  const UploadedScene& uploaded();

  const Surfels& surfels(const Experiment& experiment);
  const GpuGBuffer& gpu_surfels(const Experiment& experiment);
  const MapLayout& layout(const Experiment& experiment, std::uint32_t light);
  const CountedPixels& counted(const Experiment& experiment, std::uint32_t light);

  /// Of the experiment's technique.
  TechniqueCapabilities capabilities(const Experiment& experiment) const {
    return capabilities_of(make_technique(experiment.shadow));
  }

  const TracedVisibility& truth(const Experiment& experiment, std::uint32_t light);
  const TracedAo& ao_truth(const Experiment& experiment);
  /// Starts on another thread what ao_truth() of the same experiment then waits for. The view must stay the same until
  /// it does.
  void begin_ao_truth(const Experiment& experiment);
  /// With classes by the two-plane rule where with_truth.
  RasterVisibility draw(const Experiment& experiment, std::uint32_t light, bool with_truth);
  /// Settles by rays what the rule called false occlusion, in classes that draw() made of the same experiment.
  ClassAgreement judge(const Experiment& experiment, std::uint32_t light, WrongTaps& wrong);
  /// The error at every bias of the axes, which take the place of the experiment's; run.classes says by which classes.
  BiasHistogram bias_response(const Experiment& experiment, std::uint32_t light, const BiasAxes& axes);
  Image<float> draw_ao(const Experiment& experiment);

  /// From now on no stage shows a bar: what is traced is reported here, for a bar about more than one stage. Empty:
  /// each stage shows its bar again.
  void report_tracing(Progress to) { tracing_ = std::move(to); }

  /// Of what was traced so far.
  const Costs& costs() const { return costs_; }
  /// Every assumption made so far, once each.
  const std::vector<std::string>& notes() const { return notes_; }
  /// Adds what is new and says it.
  void add_notes(const std::vector<std::string>& notes);

 private:
  using JudgedTaps = std::function<void(std::span<const UnresolvedTap>, std::span<const std::uint8_t>)>;
  void judge_taps(const Experiment& experiment, std::uint32_t light, const BiasAxes& axes, const JudgedTaps& take);
  ShadowLookup shadow_lookup(const Experiment& experiment, std::uint32_t light, bool with_truth);
  ProgressBar bar(const char* stage) const;
  ProgressBar tracing_bar(const char* stage, std::function<std::uint64_t()> count_rays) const;
  ReferenceKey reference_key(const Experiment& experiment, Stage stage, const std::string& kind);
  std::string key(Stage stage, const Experiment& experiment, std::uint32_t light) const;
  Stage reference_stage(const Experiment& experiment, std::uint32_t light) const;

  Scene scene_;
  StageOptions options_;
  Console console_;
  Progress tracing_;
  Bounds bounds_;
  std::vector<std::string> layers_;
  std::vector<std::string> notes_;
  ReferenceCache cache_;
  Costs costs_;
  std::optional<Tracer> tracer_;
  // In this order: what lives on the GPU goes before its context does.
  std::shared_ptr<gl::Context> context_;
  std::unique_ptr<UploadedScene> uploaded_;
  Memo<Surfels> surfels_;
  Memo<GpuGBuffer> gpu_surfels_;
  Memo<MapLayout> layout_;
  Memo<CountedPixels> counted_;
  Memo<ShadowMap> map_;
  Memo<FilteredMap> filtered_map_;
  Memo<TracedVisibility> truth_;
  Memo<gl::Texture> gpu_truth_;
  Memo<TracedAo> ao_truth_;
  Memo<std::string> tracer_identity_;
  Memo<std::string> scene_content_;
  Memo<std::string> surfel_content_;
  // Last: its thread reads the tracer and the surfels until it ends.
  std::unique_ptr<AoInBackground> ao_in_background_;
};

}  // namespace umbrameter
