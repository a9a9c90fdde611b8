#include "experiments/engine/conformance.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "core/error.h"
#include "experiments/engine/frame_source.h"
#include "raytrace/tracer.h"
#include "scenes/builtin.h"
#include "scenes/light.h"

namespace umbrameter {
namespace {

// Of uneven size, so that exchanged sides show.
constexpr int width = 33;
constexpr int height = 21;

class Conformance {
 public:
  explicit Conformance(std::string adapter) : adapter_(std::move(adapter)), scene_(load_scene("corner")) {}

  std::vector<ConformanceCheck> run() {
    if (!check("starts and describes itself", [&] { engine_ = std::make_shared<Engine>(adapter_); })) return checks_;
    frames_ = frames_of(engine_);
    std::vector<std::string> notes;
    view_ = {width, height, select_camera(scene_, "", static_cast<double>(width) / height, notes)};
    gbuffer_ = trace_gbuffer(Tracer(scene_), view_);
    for (const std::string& kind : engine_->description().lights) check_light(kind);
    check("ends within five seconds at the end of its stdin", [&] {
      if (!engine_->end()) throw Error(ExitCode::usage, "adapter", "it goes on");
    });
    return checks_;
  }

 private:
  template <class Action>
  bool check(const std::string& title, const Action& action) {
    checks_.push_back({title, {}});
    try {
      action();
    } catch (const Error& error) {
      if (error.code() == ExitCode::interrupted || error.code() == ExitCode::terminated) throw;
      checks_.back().problem = error.what();
    }
    return checks_.back().problem.empty();
  }

  void check_light(const std::string& kind) {
    light_ = light_of(kind);
    const std::string of = kind + " light: ";
    const FramedView framed{scene_, kind, view_, light_};
    if (!check(of + "loads a scene", [&] { engine_->load(scene_, kind, view_, light_); })) return;
    check(of + "its surfaces lie where ours do", [&] {
      const std::optional<FrameSurfaces> surfaces = frames_.surfaces(framed);
      if (!surfaces) throw Error(ExitCode::usage, "outputs", "it writes neither position nor depth");
      const FrameAlignment alignment = align_frame(*surfaces, gbuffer_, view_);
      if (!alignment.fits()) throw Error(ExitCode::usage, "frame", misfit_text(alignment));
    });
    const auto draw = [&](const EngineParams& params) {
      std::vector<Image<float>> images;
      if (frames_.has_shadows) images.push_back(frames_.visibility(framed, {&params, 1}).front().image);
      if (frames_.has_ao) images.push_back(frames_.ao(framed, {&params, 1}).front().image);
      return images;
    };
    std::vector<Image<float>> first;
    if (!check(of + "renders with its defaults", [&] { first = draw(engine_->parameters()); })) return;
    check(of + "has a value at every surface", [&] {
      for (const Image<float>& image : first) {
        for (std::size_t i = 0; i < image.size(); ++i) {
          if (gbuffer_.is_surface(i) && !(image[i] >= 0.0f)) {
            throw Error(ExitCode::usage, fmt::format("pixel ({}, {})", i % width, i / width), "it is NaN");
          }
        }
      }
    });
    const auto require_same = [&] {
      const std::vector<Image<float>> again = draw(engine_->parameters());
      for (std::size_t n = 0; n < first.size(); ++n) {
        for (std::size_t i = 0; i < first[n].size(); ++i) {
          if (gbuffer_.is_surface(i) && first[n][i] != again[n][i]) {
            throw Error(ExitCode::usage, fmt::format("pixel ({}, {})", i % width, i / width),
                        fmt::format("it was {:.6g} and is {:.6g}", first[n][i], again[n][i]));
          }
        }
      }
    };
    check(of + "renders the same again", require_same);
    check(of + "goes on after values that it may refuse, and renders several frames at once", [&] {
      std::vector<EngineParams> frames;
      for (const bool upper : {false, true}) {
        EngineParams params = engine_->parameters();
        for (std::size_t p = 0; p < params.parameters.size(); ++p) set_limit(params.parameters[p], upper);
        frames.push_back(params);
      }
      try {
        if (frames_.has_shadows) frames_.visibility(framed, frames);
        if (frames_.has_ao) frames_.ao(framed, frames);
      } catch (const Error&) {
        if (engine_->restarts() > 0) throw;
      }
      require_same();
      if (engine_->restarts() > 0) throw Error(ExitCode::usage, "adapter", "it had to be started again");
    });
  }

  // Numbers only where both limits are known, and never so large that a map takes the memory of the machine.
  static void set_limit(EngineParameter& parameter, bool upper) {
    switch (parameter.type) {
      case EngineParameterType::number:
        if (std::isfinite(parameter.min) && std::isfinite(parameter.max)) {
          parameter.number = upper ? parameter.max : parameter.min;
        }
        return;
      case EngineParameterType::integer:
        parameter.integer = std::max(parameter.integer, 1) + (upper && parameter.integer < parameter.max ? 1 : 0);
        parameter.integer = static_cast<int>(std::clamp<double>(parameter.integer, parameter.min, parameter.max));
        return;
      case EngineParameterType::boolean:
        parameter.is_set = upper;
        return;
      case EngineParameterType::choice:
        parameter.chosen = upper ? static_cast<int>(parameter.choices.size()) - 1 : 0;
        return;
    }
  }

  // Above the scene, looking down at its middle.
  Light light_of(const std::string& kind) const {
    const Bounds bounds = bounds_of(scene_);
    Light light = scene_.lights.front();
    const dvec3 from = bounds.center() + bounds.radius() * dvec3(0.5, 1.5, 0.4);
    const dvec3 back = glm::normalize(from - bounds.center());
    const dvec3 right = glm::normalize(glm::cross(dvec3(0, 1, 0), back));
    light.world_from_light = dmat4(dvec4(right, 0), dvec4(glm::cross(back, right), 0), dvec4(back, 0), dvec4(from, 1));
    light.emitter = std::monostate{};
    if (kind == "spot") light.shape = SpotLight{0.0, 0.3, 0.8};
    if (kind == "point") light.shape = PointLight{};
    if (kind == "directional") light.shape = DirectionalLight{};
    return light;
  }

  std::string adapter_;
  Scene scene_;
  View view_;
  GBuffer gbuffer_;
  Light light_;
  std::shared_ptr<Engine> engine_;
  FrameSource frames_;
  std::vector<ConformanceCheck> checks_;
};

}  // namespace

std::vector<ConformanceCheck> check_conformance(const std::string& adapter) { return Conformance(adapter).run(); }

}  // namespace umbrameter
