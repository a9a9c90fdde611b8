#include "scenes/transparency.h"

#include <gtest/gtest.h>

#include "scenes/builtin.h"
#include "tests/scenes/gltf_files.h"
#include "tests/support/expect_words.h"

namespace umbrameter {
namespace {

// Six materials with one triangle each: plain, masked, blended, clear glass, tinted glass, and blended clear glass. The
// blended one is shown three times, the others once.
std::string panes_json() {
  return R"({"asset":{"version":"2.0"},"extensionsUsed":["KHR_materials_transmission"],
    "nodes":[{"mesh":0},{"mesh":1},{"mesh":2},{"mesh":2,"translation":[2,0,0]},{"mesh":2,"translation":[4,0,0]},
             {"mesh":3},{"mesh":4},{"mesh":5}],
    "materials":[{"name":"wall"},{"name":"leaf","alphaMode":"MASK","alphaCutoff":0.3},
      {"name":"shaft","alphaMode":"BLEND","pbrMetallicRoughness":{"baseColorFactor":[1,1,1,0.2]}},
      {"name":"clear","extensions":{"KHR_materials_transmission":{"transmissionFactor":0.9}}},
      {"name":"tinted","extensions":{"KHR_materials_transmission":{"transmissionFactor":0.5}}},
      {"name":"both","alphaMode":"BLEND","extensions":{"KHR_materials_transmission":{"transmissionFactor":1}}}],
    "meshes":[{"primitives":[{"attributes":{"POSITION":0},"material":0}]},
              {"primitives":[{"attributes":{"POSITION":0},"material":1}]},
              {"primitives":[{"attributes":{"POSITION":0},"material":2}]},
              {"primitives":[{"attributes":{"POSITION":0},"material":3}]},
              {"primitives":[{"attributes":{"POSITION":0},"material":4}]},
              {"primitives":[{"attributes":{"POSITION":0},"material":5}]}],
    "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],
    "bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36}]})";
}

Scene load_panes(BlendMode mode) {
  const TemporaryFolder folder;
  return load_scene(folder.write("panes.glb", test::glb(panes_json(), test::triangle_positions())).string(), {},
                    {"m", mode});
}

std::vector<std::string> materials_shown(const Scene& scene) {
  std::vector<std::string> names;
  for (const Instance& instance : scene.instances) {
    names.push_back(scene.materials[scene.meshes[instance.mesh].material].name);
  }
  return names;
}

std::string notes_of(const Scene& scene) {
  std::string text;
  for (const std::string& note : scene.notes) text += note + "\n";
  return text;
}

TEST(Transparency, Transmission_is_read_and_is_no_extension_without_effect) {
  const Scene scene = load_panes(BlendMode::opaque);
  EXPECT_FLOAT_EQ(scene.materials[3].transmission, 0.9f);
  EXPECT_EQ(scene.materials[0].transmission, 0.0f);
  EXPECT_EQ(notes_of(scene).find("without effect"), std::string::npos) << notes_of(scene);
}

TEST(Transparency, By_default_all_of_it_counts_as_opaque_and_a_note_says_how_much_and_what_to_set) {
  const Scene scene = load_panes(BlendMode::opaque);
  EXPECT_EQ(scene.instances.size(), 8u);
  EXPECT_EQ(scene.materials[2].alpha_mode, AlphaMode::blend);
  ASSERT_EQ(scene.notes.size(), 1u);
  // The blended triangle three times, and three of glass.
  expect_words(scene.notes[0], {"6 triangles", "'shaft', 'clear', 'tinted' and 'both'", "count as opaque",
                                "--scene.blend leave-out or mask"});
}

TEST(Transparency, Leave_out_removes_every_triangle_that_is_blended_or_transmits) {
  const Scene scene = load_panes(BlendMode::leave_out);
  EXPECT_EQ(materials_shown(scene), (std::vector<std::string>{"wall", "leaf"}));
  EXPECT_EQ(count(scene).stored_triangles, 2u);
  ASSERT_EQ(scene.notes.size(), 1u);
  expect_words(scene.notes[0], {"6 triangles", "'shaft', 'clear', 'tinted' and 'both'", "left out"});
}

TEST(Transparency, Mask_cuts_blended_ones_at_half_and_leaves_out_what_transmits_more_than_half) {
  const Scene scene = load_panes(BlendMode::mask);
  EXPECT_EQ(materials_shown(scene), (std::vector<std::string>{"wall", "leaf", "shaft", "shaft", "shaft", "tinted"}));
  EXPECT_EQ(scene.materials[2].alpha_mode, AlphaMode::mask);
  EXPECT_EQ(scene.materials[2].alpha_cutoff, 0.5f);
  EXPECT_EQ(scene.materials[1].alpha_cutoff, 0.3f) << "masks of the file stay";
  EXPECT_EQ(scene.materials[4].alpha_mode, AlphaMode::opaque);
  const std::string notes = notes_of(scene);
  expect_words(notes, {"1 triangle of the material 'tinted' transmit", "3 triangles of the material 'shaft'",
                       "2 triangles of the materials 'clear' and 'both'"});
}

TEST(Transparency, Without_such_materials_no_mode_changes_or_says_anything) {
  const Scene scene = load_scene("fence");
  for (const BlendMode mode : {BlendMode::opaque, BlendMode::leave_out, BlendMode::mask}) {
    Scene copy = scene;
    apply_blend_mode(copy, mode);
    EXPECT_EQ(copy.notes, scene.notes);
    EXPECT_EQ(count(copy).triangles, count(scene).triangles);
    EXPECT_EQ(copy.meshes.size(), scene.meshes.size());
  }
}

TEST(Transparency, Materials_without_a_name_go_by_their_index_and_long_lists_are_cut) {
  Scene scene;
  for (std::uint32_t i = 0; i < 9; ++i) {
    scene.materials.emplace_back().alpha_mode = AlphaMode::blend;
    scene.meshes.push_back({"tri", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {}, {}, {{0, 1, 2}}, i});
    scene.instances.push_back({i, 0, dmat4(1.0)});
  }
  scene.objects.resize(1);
  apply_blend_mode(scene, BlendMode::opaque);
  ASSERT_EQ(scene.notes.size(), 1u);
  expect_words(scene.notes[0], {"9 triangles of the materials 0, 1, 2, 3, 4, 5 and 3 more"});
}

TEST(Transparency, Transmission_survives_being_written) {
  Scene scene = load_panes(BlendMode::opaque);
  const std::vector<unsigned char> bytes = to_glb(scene);
  const Scene back = read_gltf(bytes, "back.glb");
  EXPECT_EQ(back.materials[3].transmission, scene.materials[3].transmission);
  EXPECT_EQ(back.materials[0].transmission, 0.0f);
}

}  // namespace
}  // namespace umbrameter
