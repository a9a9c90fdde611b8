// The key of a cached reference changes with everything that rays depend on, and with nothing else.
#include "experiments/stages/reference_key.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <set>

#include "experiments/settings/experiment.h"
#include "raytrace/tracer.h"
#include "scenes/builtin.h"

namespace umbrameter {
namespace {

// Two meshes, one of them masked by a texture; three instances.
Scene make_scene() {
  Scene scene;
  scene.textures.push_back({"leaf", Image<glm::u8vec4>(2, 2, glm::u8vec4(255)), Wrap::repeat, Wrap::repeat});
  Material solid;
  Material masked;
  masked.alpha_mode = AlphaMode::mask;
  masked.base_color_texture = 0;
  scene.materials = {solid, masked};
  const std::vector<vec3> corners = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  scene.meshes.push_back({"plain", corners, {}, {}, {{0, 1, 2}}, 0});
  scene.meshes.push_back({"leaf", corners, {}, {{0, 0}, {1, 0}, {0, 1}, {1, 1}}, {{0, 1, 2}, {2, 1, 3}}, 1});
  scene.objects = {{"first"}, {"second"}};
  scene.instances = {{0, 0, dmat4(1.0)}, {1, 0, dmat4(1.0)}, {1, 1, dmat4(2.0)}};
  scene.lights.push_back({"sun", dmat4(1.0), vec3(1), 1.0, DirectionalLight{}});
  return scene;
}

template <class T>
struct Change {
  const char* what;
  std::function<void(T&)> make;
};

template <class T, class Content>
void expect_each_to_count(const T& original, const std::vector<Change<T>>& changes, const Content& content) {
  std::set<std::string> seen = {content(original)};
  for (const Change<T>& change : changes) {
    T changed = original;
    change.make(changed);
    EXPECT_TRUE(seen.insert(content(changed)).second) << change.what;
  }
}

template <class T, class Content>
void expect_none_to_count(const T& original, const std::vector<Change<T>>& changes, const Content& content) {
  for (const Change<T>& change : changes) {
    T changed = original;
    change.make(changed);
    EXPECT_EQ(content(changed), content(original)) << change.what;
  }
}

TEST(ReferenceKey, Everything_in_the_scene_that_rays_can_meet_counts) {
  expect_each_to_count<Scene>(
      make_scene(),
      {{"a vertex, by its last bit", [](Scene& s) { s.meshes[0].positions[3].x = std::nextafter(1.0f, 2.0f); }},
       {"a triangle", [](Scene& s) { s.meshes[0].triangles[0].z = 3; }},
       {"one triangle more",
        [](Scene& s) {
          s.meshes[0].triangles.push_back({1, 2, 3});
        }},
       {"a mesh more", [](Scene& s) { s.meshes.push_back(s.meshes[0]); }},
       {"an instance's mesh", [](Scene& s) { s.instances[2].mesh = 0; }},
       {"an instance's place", [](Scene& s) { s.instances[2].world_from_mesh[3].y = 1e-300; }},
       {"an instance more", [](Scene& s) { s.instances.push_back(s.instances[0]); }},
       {"a texture coordinate", [](Scene& s) { s.meshes[1].texcoords[0].x = 0.5f; }},
       {"a texel", [](Scene& s) { s.textures[0].texels[0].w = 0; }},
       {"a wrap mode", [](Scene& s) { s.textures[0].wrap_u = Wrap::clamp_to_edge; }},
       {"the other wrap mode", [](Scene& s) { s.textures[0].wrap_v = Wrap::clamp_to_edge; }},
       {"a cutoff", [](Scene& s) { s.materials[1].alpha_cutoff = 0.25f; }},
       {"an alpha factor", [](Scene& s) { s.materials[1].base_color.w = 0.75f; }},
       {"a mask without texture", [](Scene& s) { s.materials[1].base_color_texture.reset(); }},
       {"a mask taken away", [](Scene& s) { s.materials[1].alpha_mode = AlphaMode::opaque; }},
       {"a mesh's material", [](Scene& s) { s.meshes[0].material = 1; }}},
      scene_content);
}

TEST(ReferenceKey, Names_colours_cameras_and_lights_of_the_scene_do_not_count) {
  expect_none_to_count<Scene>(
      make_scene(),
      {{"scene", [](Scene& s) { s.name = "other"; }},
       {"mesh", [](Scene& s) { s.meshes[0].name = "other"; }},
       {"colour", [](Scene& s) { s.materials[0].base_color = vec4(0.5f); }},
       {"coordinates without a mask", [](Scene& s) { s.meshes[0].texcoords.assign(4, vec2(0)); }},
       {"lights", [](Scene& s) { s.lights.clear(); }},
       {"cameras", [](Scene& s) { s.cameras.emplace_back(); }},
       {"transmission", [](Scene& s) { s.materials[0].transmission = 0.5f; }},
       {"origin", [](Scene& s) { s.origin = dvec3(1e6); }},
       {"notes", [](Scene& s) { s.notes.push_back("other"); }}},
      scene_content);
}

TEST(ReferenceKey, The_surfels_count_with_size_ids_positions_and_normals) {
  expect_each_to_count<GBuffer>(GBuffer(4, 2),
                                {{"shape", [](GBuffer& g) { g = GBuffer(2, 4); }},
                                 {"instance", [](GBuffer& g) { g.instance[3] = 1; }},
                                 {"triangle", [](GBuffer& g) { g.triangle[3] = 1; }},
                                 {"position", [](GBuffer& g) { g.position[3].y = 1e-38f; }},
                                 {"geometric normal", [](GBuffer& g) { g.geometric_normal[3].y = 1; }},
                                 {"shading normal", [](GBuffer& g) { g.shading_normal[3].y = 1; }}},
                                surfel_content);
  expect_none_to_count<GBuffer>(GBuffer(4, 2),
                                {{"albedo", [](GBuffer& g) { g.albedo[3] = vec3(1); }},
                                 {"metallic", [](GBuffer& g) { g.metallic[3] = 1.0f; }},
                                 {"specular", [](GBuffer& g) { g.specular[3] = vec4(1); }},
                                 {"depth", [](GBuffer& g) { g.depth[3] = 1.0f; }}},
                                surfel_content);
}

TEST(ReferenceKey, Kind_and_place_of_the_light_count_and_its_brightness_does_not) {
  expect_each_to_count<Light>(make_scene().lights[0],
                              {{"place", [](Light& l) { l.world_from_light[3].x = 1.0; }},
                               {"direction", [](Light& l) { l.world_from_light[2].x = 0.5; }},
                               {"extent", [](Light& l) { l.emitter = DistantEmitter{0.01}; }},
                               {"larger extent", [](Light& l) { l.emitter = DistantEmitter{0.02}; }},
                               {"spot", [](Light& l) { l.shape = SpotLight{}; }},
                               {"point", [](Light& l) { l.shape = PointLight{}; }}},
                              light_content);
  expect_none_to_count<Light>(make_scene().lights[0],
                              {{"name", [](Light& l) { l.name = "lamp"; }},
                               {"colour", [](Light& l) { l.color = vec3(0.5f); }},
                               {"intensity", [](Light& l) { l.intensity = 7.0; }}},
                              light_content);
}

TEST(ReferenceKey, Every_part_of_the_key_counts) {
  const ReferenceKey key{"ao", "program", "scene", "surfels", "light", "truth.spp=4\n", 1};
  const std::vector<Change<ReferenceKey>> changes = {
      {"kind", [](ReferenceKey& k) { k.kind = "visibility"; }},
      {"tracer", [](ReferenceKey& k) { k.tracer = "other"; }},
      {"scene", [](ReferenceKey& k) { k.scene = "other"; }},
      {"surfels", [](ReferenceKey& k) { k.surfels = "other"; }},
      {"light", [](ReferenceKey& k) { k.light = "other"; }},
      {"parameters", [](ReferenceKey& k) { k.parameters = "truth.spp=5\n"; }},
      {"seed", [](ReferenceKey& k) { k.seed = 2; }}};
  EXPECT_EQ(static_cast<int>(changes.size()), count_fields<ReferenceKey>()) << "a field is not tried";
  expect_each_to_count<ReferenceKey>(key, changes, to_text);
}

TEST(ReferenceKey, Every_reference_parameter_counts) {
  TruthParams params;
  const Parameters parameters = describe(params);
  EXPECT_EQ(static_cast<int>(parameters.size()), count_fields<TruthParams>()) << "a field is not described";
  const std::string before = key_of(parameters);
  for (const Parameter& parameter : parameters) {
    const Value kept = parameter.value();
    if (const auto* truth = std::get_if<bool>(&kept)) {
      parameter.set(!*truth);
    } else if (const auto* choice = std::get_if<ChoiceRef>(&parameter.field)) {
      *choice->value = *choice->value == 0 ? 1 : 0;
    } else if (std::holds_alternative<Length*>(parameter.field)) {
      parameter.set_text("17cm");
    } else if (std::holds_alternative<std::string>(kept)) {
      parameter.set_text("other");
    } else {
      const double low = std::isfinite(parameter.description.min) ? parameter.description.min : 0.0;
      parameter.set_text(to_string(kept) == to_string(Value(low)) ? std::to_string(static_cast<int>(low) + 1)
                                                                  : to_string(Value(low)));
    }
    EXPECT_NE(key_of(parameters), before) << parameter.key;
    parameter.set(kept);
    EXPECT_EQ(key_of(parameters), before) << parameter.key;
  }
}

TEST(ReferenceKey, A_loaded_scene_has_the_same_content_each_time) {
  EXPECT_EQ(scene_content(load_scene("fence")), scene_content(load_scene("fence")));
  EXPECT_NE(scene_content(load_scene("fence")), scene_content(load_scene("corner")));
}

TEST(ReferenceKey, The_tracer_is_known_by_program_processor_and_library) {
  EXPECT_EQ(tracer_identity(), tracer_identity());
  EXPECT_NE(tracer_identity().find("Embree " + loaded_embree_version()), std::string::npos);
}

}  // namespace
}  // namespace umbrameter
