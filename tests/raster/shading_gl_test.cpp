#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>
#include <sstream>

#include "raster/gl/api.h"
#include "raster/shader_interface.h"
#include "raster/shading/shading_pass.h"
#include "scenes/builtin.h"
#include "scenes/view.h"
#include "techniques/shading/light_model.h"
#include "test_scenes.h"
#include "tests/support/reference/volume_counters.h"

namespace umbrameter {
namespace {

using namespace testing_scenes;

// A G-buffer of 32-bit floats, which loses only the rounding to floats.
ShadingParams float_gbuffer() {
  ShadingParams params;
  params.normal_format = NormalFormat::rgb32f;
  params.depth_format = DepthFormat::depth32f;
  params.position = PositionSource::stored;
  params.color_format = ColorFormat::rgba32f;
  return params;
}

// One input and one output of the light model, std430.
struct ModelInput {
  vec4 position, normal, to_viewer, diffuse, specular;  // w of specular: shininess
  shared::LightSource light;
};
struct ModelOutput {
  vec4 diffuse, specular;
};

constexpr std::string_view model_shader = R"(
#include "light_model.glsl"
layout(local_size_x = 64) in;
struct Input { vec4 position, normal, to_viewer, diffuse, specular; LightSource light; };
struct Output { vec4 diffuse, specular; };
layout(std430, binding = 0) readonly buffer Inputs { Input inputs[]; };
layout(std430, binding = 1) writeonly buffer Outputs { Output outputs[]; };
layout(std140, binding = 0) uniform Model { LightModel model; };
void main() {
  uint i = gl_GlobalInvocationID.x;
  Input given = inputs[i];
  SurfacePoint surface;
  surface.position = given.position.xyz;
  surface.normal = given.normal.xyz;
  surface.to_viewer = given.to_viewer.xyz;
  surface.diffuse = given.diffuse.xyz;
  surface.specular = given.specular.xyz;
  surface.shininess = given.specular.w;
  Reflection reflection = reflect_light(surface, given.light, model);
  outputs[i].diffuse = vec4(reflection.diffuse, is_in_volume(surface.position, given.light) ? 1 : 0);
  outputs[i].specular = vec4(reflection.specular, 0);
}
)";

class ShadingGl : public GlTest {
 protected:
  std::vector<ModelOutput> evaluate(const std::vector<ModelInput>& inputs, const ShadingParams& params) const {
    const gl::LinkedProgram linked = gl::make_program({{"model.comp"}, interface_defines()}, [](std::string_view file) {
      return file == "model.comp" ? std::optional(model_shader) : gl::embedded_shader(file);
    });
    const gl::Buffer given = gl::make_buffer("inputs", std::span<const ModelInput>(inputs));
    std::vector<ModelOutput> outputs(inputs.size());
    const gl::Buffer found = gl::make_empty_buffer("outputs", outputs.size() * sizeof(ModelOutput));
    const gl::Buffer model = gl::make_block("model", light_model(params));
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, given.name());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, found.name());
    glBindBufferBase(GL_UNIFORM_BUFFER, 0, model.name());
    glUseProgram(linked.program.name());
    glDispatchCompute(static_cast<unsigned>(inputs.size() / 64), 1, 1);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    gl::read_buffer(found, std::as_writable_bytes(std::span(outputs)));
    context().check("light model");
    return outputs;
  }
};

std::vector<ModelInput> random_inputs(std::size_t count) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> any(0.0f, 1.0f);
  const auto unit = [&] {
    const float z = 2.0f * any(random) - 1.0f;
    const float angle = 6.2831853f * any(random);
    const float r = std::sqrt(1.0f - z * z);
    return vec3(r * std::cos(angle), r * std::sin(angle), z);
  };
  const auto color = [&] { return vec3(any(random), any(random), any(random)); };
  std::vector<ModelInput> inputs(count);
  for (ModelInput& input : inputs) {
    Light light;
    const float kind = any(random);
    const double range = any(random) < 0.5f ? 0.0 : 5.0 + 5.0 * any(random);
    const double outer = 0.1 + 1.4 * any(random);
    if (kind < 0.3f) {
      light.shape = DirectionalLight{};
    } else if (kind < 0.6f) {
      light.shape = PointLight{range};
    } else {
      light.shape = SpotLight{range, outer * any(random), outer};
    }
    const dvec3 z(unit());
    const dvec3 x = glm::normalize(glm::cross(std::abs(z.y) < 0.9 ? dvec3(0, 1, 0) : dvec3(1, 0, 0), z));
    light.world_from_light = dmat4(dmat3(x, glm::cross(z, x), z));
    light.world_from_light[3] = dvec4(5.0 * dvec3(unit()), 1.0);
    light.intensity = 1.0 + 50.0 * any(random);
    light.color = color();
    input.position = vec4(3.0f * unit(), 0.0f);
    input.normal = vec4(unit(), 0.0f);
    input.to_viewer = vec4(unit(), 0.0f);
    input.diffuse = vec4(color(), 0.0f);
    input.specular = vec4(color(), shared::shininess_of(any(random)));
    input.light = light_source(light);
  }
  return inputs;
}

TEST_F(ShadingGl, The_shader_and_the_processor_agree_on_a_million_random_inputs) {
  std::size_t lit = 0;
  double worst = 0.0;
  std::size_t volume_differs = 0;
  const std::vector<ModelInput> inputs = random_inputs(62'528);
  for (int choice = 0; choice < 16; ++choice) {
    ShadingParams params;
    params.specular = static_cast<SpecularModel>(choice & 1);
    params.normalization = static_cast<ShadingNormalization>(choice >> 1 & 1);
    params.attenuation = static_cast<Attenuation>(choice >> 2 & 1);
    params.spot_falloff = static_cast<SpotFalloff>(choice >> 3 & 1);
    params.linear = 0.2;
    const shared::LightModel model = light_model(params);
    const std::vector<ModelOutput> outputs = evaluate(inputs, params);
    for (std::size_t i = 0; i < inputs.size(); ++i) {
      const ModelInput& in = inputs[i];
      const shared::Reflection expected = reflect_light(
          {vec3(in.position), vec3(in.normal), vec3(in.to_viewer), vec3(in.diffuse), vec3(in.specular), in.specular.w},
          in.light, model);
      if (expected.diffuse != vec3(0)) ++lit;
      for (int c = 0; c < 3; ++c) {
        worst = std::max<double>(
            worst, std::abs(outputs[i].diffuse[c] - expected.diffuse[c]) / std::max(expected.diffuse[c], 1.0f));
        worst = std::max<double>(
            worst, std::abs(outputs[i].specular[c] - expected.specular[c]) / std::max(expected.specular[c], 1.0f));
      }
      if ((outputs[i].diffuse.w != 0.0f) != shared::is_in_volume(vec3(in.position), in.light)) ++volume_differs;
    }
  }
  EXPECT_GT(lit, 200'000u);
  // A lobe multiplies the relative error of its cosine, two roundings, by its exponent, which is 2048 at most.
  EXPECT_LT(worst, 2048 * 2 * 0x1p-23);
  EXPECT_LT(volume_differs, 3u);  // on the boundary, to the last bit
}

// What both paths read, without shadow maps: visibility and AO are patterns.
struct Lit {
  Scene scene;
  View view;
  std::vector<Image<float>> visibilities;
  std::vector<LitLight> lights;
  Image<float> ao;
};

std::unique_ptr<Lit> lit_scene(const std::string& name, int width, int height, double range_at_camera = 0.0) {
  auto lit = std::make_unique<Lit>();
  lit->scene = load_scene(name);
  std::vector<std::string> notes;
  lit->view = {width, height, select_camera(lit->scene, "", static_cast<double>(width) / height, notes)};
  if (range_at_camera > 0.0) {
    Light& light = lit->scene.lights.emplace_back();
    light.shape = PointLight{range_at_camera};
    light.world_from_light[3] = lit->view.camera.world_from_camera[3];
  }
  lit->ao = Image<float>(width, height, 0.0f);
  for (std::size_t i = 0; i < lit->ao.size(); ++i) lit->ao[i] = 0.25f * static_cast<float>(1 + i % 4);
  for (std::size_t l = 0; l < lit->scene.lights.size(); ++l) {
    Image<float>& visibility = lit->visibilities.emplace_back(width, height, 1.0f);
    for (std::size_t i = 0; i < visibility.size(); ++i) visibility[i] = (i / 7 + l) % 3 == 0 ? 0.5f : 1.0f;
  }
  for (std::size_t l = 0; l < lit->scene.lights.size(); ++l) {
    lit->lights.push_back({&lit->scene.lights[l], &lit->visibilities[l]});
  }
  return lit;
}

int steps_of_8_bits(const vec3& a, const vec3& b) {
  const auto step = [](float x) {
    const float c = std::clamp(x, 0.0f, 1.0f);
    return static_cast<int>(255.0f * (c <= 0.0031308f ? 12.92f * c : 1.055f * std::pow(c, 1.0f / 2.4f) - 0.055f) +
                            0.5f);
  };
  int most = 0;
  for (int c = 0; c < 3; ++c) most = std::max(most, std::abs(step(a[c]) - step(b[c])));
  return most;
}

TEST_F(ShadingGl, Both_paths_and_both_ways_to_cull_give_the_same_image) {
  for (const char* name : {"courtyard", "courtyard:64", "courtyard:256"}) {
    const auto lit = lit_scene(name, 240, 135);
    const UploadedScene scene = upload(context(), lit->scene);
    const GpuGBuffer surfels = draw_gbuffer(context(), scene, lit->view);
    ShadingParams params = float_gbuffer();
    const ShadedImage forward = draw_forward(context(), {scene, surfels, lit->view, params}, lit->lights, lit->ao);
    const GBuffer gbuffer = read_back(context(), surfels);
    Image<vec3> on_processor(240, 135, vec3(0));
    for (const LitLight& light : lit->lights) {
      add_light(on_processor, gbuffer, lit->view, *light.light, *light.visibility, params);
    }
    add_ambient(on_processor, gbuffer, lit->view, lit->ao, params);
    const StoredGBuffer stored = store_gbuffer(context(), surfels, lit->view, params);
    for (const VolumeFaces faces : {VolumeFaces::front, VolumeFaces::back}) {
      params.volume_faces = faces;
      const ShadedImage deferred = draw_deferred(context(), {stored, surfels, lit->view, params}, lit->lights, lit->ao);
      std::size_t missed = 0;
      for (const LightCounters& counters : deferred.counters) missed += counters.missed;
      std::size_t different = 0;
      std::ostringstream where;
      std::size_t bright = 0;
      for (std::size_t i = 0; i < on_processor.size(); ++i) {
        if (steps_of_8_bits(deferred.radiance[i], forward.radiance[i]) > 1) {
          ++different;
          where << " " << i % 240 << "," << i / 240 << " depth " << gbuffer.depth[i] << " at " << gbuffer.position[i].x
                << " " << gbuffer.position[i].y << " " << gbuffer.position[i].z << " triangle " << gbuffer.triangle[i]
                << " of " << gbuffer.instance[i];
        }
        if (forward.radiance[i].y > 0.05f) ++bright;
        EXPECT_LE(steps_of_8_bits(on_processor[i], forward.radiance[i]), 1) << name << " " << i;
      }
      EXPECT_LE(different, missed) << name << ", " << (faces == VolumeFaces::front ? "front" : "back");
      for (std::size_t l = 0; l < deferred.counters.size() && faces == VolumeFaces::back; ++l) {
        EXPECT_EQ(deferred.counters[l].missed, 0u)
            << name << ", light " << l << " at " << lit->scene.lights[l].position().x << " "
            << lit->scene.lights[l].position().y << " " << lit->scene.lights[l].position().z << ":" << where.str();
      }
      EXPECT_GT(bright, 10'000u) << name;
    }
  }
}

TEST_F(ShadingGl, Counters_of_light_volumes_are_those_of_rays_through_the_pixels) {
  const auto lit = lit_scene("courtyard:64", 160, 90, 20.0);
  // Volumes reach behind the far plane, which must not cut off their back faces.
  std::get<PerspectiveProjection>(lit->view.camera.projection).far_plane = 14.0;
  const UploadedScene scene = upload(context(), lit->scene);
  const GpuGBuffer surfels = draw_gbuffer(context(), scene, lit->view);
  const GBuffer gbuffer = read_back(context(), surfels);
  ShadingParams params = float_gbuffer();
  const StoredGBuffer stored = store_gbuffer(context(), surfels, lit->view, params);
  std::uint64_t missed = 0;
  std::uint64_t missed_by_front = 0;
  for (const VolumeFaces faces : {VolumeFaces::front, VolumeFaces::back}) {
    params.volume_faces = faces;
    const ShadedImage image = draw_deferred(context(), {stored, surfels, lit->view, params}, lit->lights, lit->ao);
    std::uint64_t shaded = 0;
    std::uint64_t in_vain = 0;
    std::uint64_t undecided = 0;
    for (std::size_t l = 0; l < lit->lights.size(); ++l) {
      const VolumeCount expected = count_volume(gbuffer, lit->view, *lit->lights[l].light, faces);
      const LightCounters& found = image.counters[l];
      const auto near = [&](std::uint32_t a, std::uint32_t b) {
        return std::max(a, b) - std::min(a, b) <= expected.undecided;
      };
      EXPECT_TRUE(near(found.shaded, expected.counters.shaded))
          << l << ": " << found.shaded << ", " << expected.counters.shaded;
      EXPECT_TRUE(near(found.in_vain, expected.counters.in_vain))
          << l << ": " << found.in_vain << ", " << expected.counters.in_vain;
      EXPECT_TRUE(near(found.missed, expected.counters.missed))
          << l << ": " << found.missed << ", " << expected.counters.missed;
      shaded += found.shaded;
      in_vain += found.in_vain;
      missed += found.missed;
      undecided += expected.undecided;
    }
    EXPECT_GT(shaded, 10'000u);
    EXPECT_GT(in_vain, 1'000u);
    if (faces == VolumeFaces::back) {
      EXPECT_EQ(missed, missed_by_front);
    }
    missed_by_front = missed;
    EXPECT_LT(undecided, shaded / 50) << "most pixels are decided";
  }
  EXPECT_GT(missed, 0u) << "the camera is inside a volume, whose front faces it does not see";
}

TEST_F(ShadingGl, A_compact_gbuffer_loses_what_its_formats_say) {
  const auto lit = lit_scene("courtyard", 240, 135);
  const GpuGBuffer surfels = draw_gbuffer(context(), upload(context(), lit->scene), lit->view);
  const GBuffer exact = read_back(context(), surfels);
  struct Case {
    NormalFormat normals;
    double most;  // of the angle, radians
  };
  // Half a step of 2/255 on each axis; half a step of a 16-bit float near 1, 2^-12, on each; octahedral 2/65535.
  for (const Case& c : {Case{NormalFormat::rgb32f, 0.0}, Case{NormalFormat::rgb16f, 4.3e-4},
                        Case{NormalFormat::rg16, 7e-5}, Case{NormalFormat::rgb8, 6.8e-3}}) {
    ShadingParams params = float_gbuffer();
    params.normal_format = c.normals;
    const GBuffer decoded = read_back(
        context(), decode_surfels(context(), store_gbuffer(context(), surfels, lit->view, params), surfels, lit->view));
    double worst = 0.0;
    for (std::size_t i = 0; i < exact.position.size(); ++i) {
      EXPECT_EQ(decoded.instance[i], exact.instance[i]);
      EXPECT_EQ(decoded.position[i], exact.position[i]);
      if (!exact.is_surface(i)) continue;
      worst = std::max<double>(worst, glm::length(decoded.shading_normal[i] - exact.shading_normal[i]));
    }
    EXPECT_LE(worst, c.most);
    EXPECT_GE(worst, 0.1 * c.most);
  }
  for (const DepthFormat depth : {DepthFormat::depth32f, DepthFormat::depth24, DepthFormat::depth16}) {
    ShadingParams params = float_gbuffer();
    params.position = PositionSource::depth;
    params.depth_format = depth;
    const GBuffer decoded = read_back(
        context(), decode_surfels(context(), store_gbuffer(context(), surfels, lit->view, params), surfels, lit->view));
    // Reversed depth of a far plane at infinity is near / z: half a step dz = step · z² / near, along the ray.
    const double near_plane = std::get<PerspectiveProjection>(lit->view.camera.projection).near_plane;
    const double step = depth == DepthFormat::depth16   ? 1.0 / 65535
                        : depth == DepthFormat::depth24 ? 1.0 / 16777215
                                                        : 0.0;
    double worst = 0.0;
    for (std::size_t i = 0; i < exact.position.size(); ++i) {
      if (!exact.is_surface(i)) continue;
      const double z = exact.depth[i];
      // The matrix is of floats: some 1e-6 of the distance, and of the depth's own size.
      const double bound = 0.6 * step * z * z / near_plane + 2e-5 * z;
      EXPECT_LE(std::abs(decoded.depth[i] - z), bound);
      worst = std::max(worst, std::abs(decoded.depth[i] - z) / bound);
    }
    EXPECT_GT(worst, depth == DepthFormat::depth32f ? 0.0 : 0.3);
  }
}

}  // namespace
}  // namespace umbrameter
