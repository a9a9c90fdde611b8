#include <algorithm>
#include <span>

#include "raster/gbuffer/view_block.h"
#include "raster/gl/target.h"
#include "raster/gl/timer.h"
#include "raster/shader_interface.h"
#include "raster/shading/light_buffers.h"
#include "raster/shading/shading_pass.h"
#include "raster/texture_image.h"

namespace umbrameter {
namespace {

gl::Buffer make_counters(const std::string& label, std::size_t count) {
  const std::vector<std::uint32_t> zeros(std::max<std::size_t>(count, 1), 0u);
  return gl::make_buffer(label, std::span<const std::uint32_t>(zeros));
}

std::vector<std::uint32_t> read_counters(const gl::Buffer& buffer, std::size_t count) {
  std::vector<std::uint32_t> counters(count);
  gl::read_buffer(buffer, std::as_writable_bytes(std::span(counters)));
  return counters;
}

// The corners of all triangles, for a draw without an index buffer.
gl::Buffer make_vertices(const LightVolume& volume) {
  std::vector<vec3> vertices;
  for (const uvec3& t : volume.triangles) {
    for (int i = 0; i < 3; ++i) vertices.push_back(volume.positions[t[i]]);
  }
  return gl::make_buffer("light volume", std::span<const vec3>(vertices));
}

// Draws the lights into the light buffer one by one, then counts the fragments of their volumes.
class DeferredLights {
 public:
  /// What a light's draw reads.
  struct Prepared {
    std::size_t light = 0;
    gl::Texture visibility;
    int volume_vertices = 0;  ///< 0: the light is drawn over the whole image
    gl::Buffer vertices;
    gl::Texture vertex_texels;
  };

  DeferredLights(const gl::Context& context, const DeferredInput& input, std::span<const LitLight> lights)
      : context_(context),
        input_(input),
        lights_(lights),
        light_buffer_(make_light_buffer(lights)),
        counters_(make_counters("light counters", 2 * lights.size())),
        has_volume_(lights.size()) {}

  Prepared prepare(std::size_t i) {
    const std::optional<LightVolume> volume = light_volume(*lights_[i].light);
    has_volume_[i] = volume.has_value();
    Prepared prepared;
    prepared.light = i;
    prepared.visibility = upload_image("visibility", gl::Format::r32f, *lights_[i].visibility);
    if (!volume) return prepared;
    prepared.volume_vertices = static_cast<int>(3 * volume->triangles.size());
    prepared.vertices = make_vertices(*volume);
    prepared.vertex_texels = gl::make_buffer_texture("light volume", gl::Format::rgb32f, prepared.vertices);
    return prepared;
  }

  void add(const Prepared& prepared, const gl::Target& target) const {
    const bool has_volume = prepared.volume_vertices > 0;
    const bool counts = has_volume && input_.times == nullptr;
    gl::Pass pass(context_, {{has_volume ? "light_volume.vert" : "fullscreen.vert", "deferred_light.frag"},
                             stored_gbuffer_defines(input_.stored.formats) + define("COUNTS_FRAGMENTS", counts)});
    bind(pass);
    pass.texture("visibility", prepared.visibility)
        .buffer("Counters", counters_)
        .value("light", static_cast<int>(prepared.light));
    if (!has_volume) {
      target.begin({.adds = true});
      pass.use();
      gl::draw_triangles(3);
      return;
    }
    const bool draws_front = input_.params.volume_faces == VolumeFaces::front;
    target.begin({.depth = draws_front ? gl::DepthTest::nearer : gl::DepthTest::farther,
                  .faces = draws_front ? gl::DrawnFaces::front : gl::DrawnFaces::back,
                  .adds = true});
    pass.texture("volume_vertices", prepared.vertex_texels).use();
    gl::draw_triangles(prepared.volume_vertices);
  }

  std::vector<LightCounters> count() const {
    const gl::Buffer reached = make_counters("surfels reached", lights_.size());
    gl::Pass pass(context_, {{"count_reached.comp"}, stored_gbuffer_defines(input_.stored.formats)});
    bind(pass);
    pass.buffer("Reached", reached).dispatch(input_.surfels.width, input_.surfels.height);
    const std::vector<std::uint32_t> inside = read_counters(reached, lights_.size());
    const std::vector<std::uint32_t> shaded = read_counters(counters_, 2 * lights_.size());
    std::vector<LightCounters> counters(lights_.size());
    for (std::size_t i = 0; i < lights_.size(); ++i) {
      if (!has_volume_[i]) continue;
      counters[i] = {shaded[2 * i], shaded[2 * i + 1], 0};
      counters[i].missed = inside[i] - (counters[i].shaded - counters[i].in_vain);
    }
    return counters;
  }

 private:
  void bind(gl::Pass& pass) const {
    bind_stored(pass, input_, static_cast<int>(lights_.size()));
    pass.buffer("Lights", light_buffer_);
  }

  const gl::Context& context_;
  const DeferredInput& input_;
  std::span<const LitLight> lights_;
  gl::Buffer light_buffer_;
  gl::Buffer counters_;  // those of deferred_light.frag
  std::vector<bool> has_volume_;
};

}  // namespace

gl::Buffer make_light_buffer(std::span<const LitLight> lights) {
  std::vector<shared::LightSource> sources;
  for (const LitLight& lit : lights) sources.push_back(light_source(*lit.light));
  return gl::make_buffer("lights", std::span<const shared::LightSource>(sources));
}

Image<vec3> read_colors(const gl::Texture& texture) {
  const Image<vec4> wide = read_image<vec4>(texture, gl::Format::rgba32f);
  Image<vec3> colors(wide.width, wide.height);
  for (std::size_t i = 0; i < wide.size(); ++i) colors[i] = vec3(wide[i]);
  return colors;
}

ShadedImage draw_deferred(const gl::Context& context, const DeferredInput& input, std::span<const LitLight> lights,
                          const Image<float>& ao) {
  const auto make = [&](const char* label) {
    return gl::make_texture(label, gl::Format::rgba32f, input.surfels.width, input.surfels.height);
  };
  const gl::Texture light_buffer = make("light buffer");
  ShadedImage image;
  {
    DeferredLights pass(context, input, lights);
    {
      const gl::Target target("light buffer", {&light_buffer}, &input.stored.depth);
      target.clear_colors();
      for (std::size_t first = 0; first < lights.size(); first += lights_per_pass) {
        std::vector<DeferredLights::Prepared> batch;
        for (std::size_t i = first; i < std::min(first + lights_per_pass, lights.size()); ++i) {
          batch.push_back(pass.prepare(i));
        }
        gl::run_timed(input.times != nullptr ? &input.times->lights : nullptr, [&] {
          for (const DeferredLights::Prepared& light : batch) pass.add(light, target);
        });
      }
    }
    gl::make_writes_visible();
    if (input.times == nullptr) image.counters = pass.count();
  }
  const gl::Texture radiance = make("radiance");
  const gl::Texture accessibility = upload_image("accessibility", gl::Format::r32f, ao);
  gl::Pass resolve(context, {{"resolve_shading.comp"}, stored_gbuffer_defines(input.stored.formats)});
  bind_stored(resolve, input, static_cast<int>(lights.size()));
  resolve.texture("light_buffer", light_buffer)
      .texture("ao", accessibility)
      .image("radiance", radiance, gl::Format::rgba32f);
  gl::run_timed(input.times != nullptr ? &input.times->resolve : nullptr,
                [&] { resolve.dispatch(input.surfels.width, input.surfels.height); });
  image.radiance = read_colors(radiance);
  image.light_buffer = read_colors(light_buffer);
  context.check("deferred shading");
  return image;
}

}  // namespace umbrameter
