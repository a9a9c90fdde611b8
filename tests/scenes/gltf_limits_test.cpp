// What a few bytes may ask for: sizes that overflow, memory that nothing in the file stands for, files that lead away.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <limits>

#include "gltf_files.h"

namespace umbrameter {
namespace {

using test::broken;
using test::Bytes;
using test::bytes_of;
using test::expect_unreadable;
using test::glb;
using test::replaced;
using test::TemporaryFolder;
using test::triangle_json;
using test::triangle_positions;

std::span<const unsigned char> bytes_in(const std::string& text) {
  return {reinterpret_cast<const unsigned char*>(text.data()), text.size()};
}

/// The most memory that the process has held, bytes.
std::int64_t peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return std::int64_t{usage.ru_maxrss} << 10;
}

/// Expects an Error of `words`, while the process grows by less than `growth` bytes beyond what it held.
void expect_refused(const std::string& text, const std::string& words, std::int64_t growth) {
  const std::int64_t before = peak_memory();
  try {
    read_gltf(bytes_in(text), "nowhere/test.gltf");
    ADD_FAILURE() << "it was read";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::unreadable_input);
    EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
  }
  EXPECT_LT(peak_memory() - before, growth);
}

constexpr std::int64_t mebibyte = 1 << 20;

/// The triangle with material 0 of these members.
std::string textured(const std::string& more) {
  return replaced(triangle_json(R"("nodes":[{"mesh":0}])", more), R"("attributes")", R"("material":0,"attributes")");
}

TEST(GltfLimits, Strides_and_offsets_that_would_overflow_are_refused) {
  const std::string view = R"({"buffer":0,"byteLength":36})";
  expect_unreadable(broken(view, R"({"buffer":0,"byteLength":36,"byteStride":252})"), {"accessor 0", "beyond"});
  expect_unreadable(broken(view, R"({"buffer":0,"byteLength":36,"byteStride":8})"), {"less than one element"});
  expect_unreadable(broken(view, R"({"buffer":0,"byteLength":36,"byteStride":2147483644})"), {"byteStride"});
  expect_unreadable(broken(view, R"({"buffer":0,"byteLength":1099511627776})"), {"bufferView 0", "beyond"});
  expect_unreadable(broken(view, R"({"buffer":0,"byteOffset":1099511627776,"byteLength":36})"), {"beyond"});
  expect_unreadable(broken(view, R"({"buffer":0,"byteOffset":18446744073709551600,"byteLength":36})"), {"range"});
  expect_unreadable(broken(view, R"({"buffer":0,"byteOffset":-4,"byteLength":36})"), {"byteOffset", "range"});
  expect_unreadable(broken(R"("count":3)", R"("byteOffset":1099511627776,"count":3)"), {"accessor 0", "beyond"});
  expect_unreadable(broken(R"("count":3)", R"("count":2147483647)"), {"accessor 0", "beyond"});
}

TEST(GltfLimits, A_binary_file_whose_length_lies_is_refused_or_read_to_that_length) {
  const Bytes whole = glb(triangle_json(), triangle_positions());
  const auto with_word = [&](std::size_t at, std::size_t value) {
    Bytes bytes = whole;
    for (std::size_t i = 0; i < 4; ++i) bytes[at + i] = static_cast<unsigned char>(value >> (8 * i));
    return bytes;
  };
  constexpr std::size_t length = 8;
  constexpr std::size_t json_length = 12;
  const std::size_t binary_length = 20 + (whole.size() - 20 - 8 - 36);
  expect_unreadable(with_word(length, whole.size() + 4), {"header", "truncated"});
  expect_unreadable(with_word(length, whole.size() - 4), {"chunk 1", "truncated"});
  expect_unreadable(with_word(length, 0xffffffff), {"header", "truncated"});
  expect_unreadable(with_word(json_length, 0xffffffff), {"chunk 0", "truncated"});
  expect_unreadable(with_word(json_length, 8), {"chunk"});
  expect_unreadable(with_word(binary_length, 0x7fffffff), {"chunk 1", "truncated"});
  expect_unreadable(with_word(binary_length, 32), {});
  Bytes trailing = whole;
  trailing.insert(trailing.end(), 64, 0xab);
  EXPECT_EQ(count(read_gltf(trailing, "test.glb")).triangles, 1u);
}

TEST(GltfLimits, A_million_nodes_deep_is_a_scene) {
  constexpr int depth = 1'000'000;
  std::string text = R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[)";
  for (int i = 1; i < depth; ++i) text += R"({"translation":[0.5,0,0],"children":[)" + std::to_string(i) + "]},";
  const std::string rest = triangle_json(
      R"("nodes":[])", "",
      R"({"byteLength":36,"uri":"data:application/gltf-buffer;base64,)" + test::base64(triangle_positions()) + R"("})");
  text += R"({"mesh":0}])" + rest.substr(rest.find(R"(,"buffers")"));
  const Scene scene = read_gltf(bytes_in(text), "deep.gltf");
  ASSERT_EQ(scene.instances.size(), 1u);
  EXPECT_EQ(world_triangle(scene, 0, 0).a, dvec3(0.5 * (depth - 1), 0, 0));
}

TEST(GltfLimits, A_gibibyte_of_JSON_is_refused_before_it_is_parsed) {
  std::string text = R"({"asset":{"version":"2.0"},"nodes":[)";
  text.reserve(std::size_t{1} << 30);
  while (text.size() + 3 < (std::size_t{1} << 30)) text += "{},";
  expect_refused(text, "more than 33554432 values", 64 * mebibyte);
}

TEST(GltfLimits, What_brackets_and_counts_ask_for_is_bound_to_the_size_of_the_file) {
  const std::string start = R"({"asset":{"version":"2.0"},)";
  std::string many;
  for (int i = 0; i < 300'000; ++i) many += "{},";
  // The parser would keep two kilobytes of each.
  expect_refused(start + R"("materials":[)" + many + "{}]}", "materials", 400 * mebibyte);
  expect_refused(start + R"("nodes":)" + std::string(100'000, '[') + std::string(100'000, ']') + "}", "64 levels",
                 16 * mebibyte);
  const std::string zeros = R"("nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],)"
                            R"("accessors":[{"componentType":5126,"type":"VEC3","count":2000000000}]})";
  expect_refused(start + zeros, "accessor 0 of mesh 0 primitive 0", 64 * mebibyte);
  const std::string crowd =
      R"("nodes":[{"mesh":0,"extensions":{"EXT_mesh_gpu_instancing":{"attributes":{"SCALE":1}}}}],)";
  const std::string million = R"("accessors":[{"componentType":5126,"type":"VEC3","count":3,"bufferView":0},)"
                              R"({"componentType":5126,"type":"VEC3","count":20000000}])";
  std::string json = triangle_json(crowd.substr(0, crowd.size() - 1));
  json = replaced(json, R"("accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}])", million);
  const Bytes bytes = glb(json, triangle_positions());
  expect_unreadable(bytes, {"node 0", "it would unpack to", "MiB"});
}

TEST(GltfLimits, One_mesh_of_many_parts_under_many_nodes_is_bound_too) {
  std::string nodes = R"("nodes":[{"mesh":0})";
  for (int i = 0; i < 20'000; ++i) nodes += R"(,{"mesh":0})";
  std::string primitives = R"({"attributes":{"POSITION":0}})";
  for (int i = 0; i < 2'000; ++i) primitives += R"(,{"attributes":{"POSITION":0}})";
  const std::string json = replaced(triangle_json(nodes + "]"), R"({"attributes":{"POSITION":0}})", primitives);
  expect_unreadable(glb(json, triangle_positions()), {"node ", "it would unpack to"});
}

TEST(GltfLimits, Images_are_refused_by_their_header_alone) {
  const TemporaryFolder folder;
  // PNG signature and an IHDR of 16000 by 16000: 2 GiB with the decoder's copy.
  Bytes png = {0x89, 'P',  'N',  'G', 13, 10,   26,   10, 0, 0, 0, 13, 'I', 'H', 'D', 'R', 0,
               0,    0x3e, 0x80, 0,   0,  0x3e, 0x80, 8,  6, 0, 0, 0,  0,   0,   0,   0};
  // The start of its pixels, which is as far as the decoder reads to learn what it is.
  png.insert(png.end(), {0, 0, 0, 16, 'I', 'D', 'A', 'T'});
  png.resize(64);
  folder.write("bomb.png", png);
  const std::string json =
      textured(R"("materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}],"textures":[{"source":0}],)"
               R"("images":[{"uri":"bomb.png"}])");
  const auto path = folder.write("test.glb", glb(json, triangle_positions()));
  const std::int64_t before = peak_memory();
  expect_unreadable(path, {"image 0", "16000x16000", "1024 MiB", "--memory"});
  EXPECT_LT(peak_memory() - before, 16 * mebibyte);
}

TEST(GltfLimits, References_out_of_the_folder_are_refused_however_they_are_written) {
  const TemporaryFolder outside;
  outside.write("positions.bin", triangle_positions());
  const TemporaryFolder folder;
  folder.write("positions.bin", triangle_positions());
  std::filesystem::create_directory(folder.path() / "inner");
  std::filesystem::create_symlink(outside.path() / "positions.bin", folder.path() / "link.bin");
  std::filesystem::create_directory_symlink(outside.path(), folder.path() / "linked");
  std::filesystem::create_symlink(folder.path() / "positions.bin", folder.path() / "inner" / "alias.bin");
  const auto write = [&](const std::string& uri) {
    return folder.write("test.gltf",
                        triangle_json(R"("nodes":[{"mesh":0}])", "", R"({"byteLength":36,"uri":")" + uri + "\"}"));
  };
  for (const char* fine : {"positions.bin", "./positions.bin", "%70ositions.bin", "inner/alias.bin"}) {
    EXPECT_EQ(count(load_gltf(write(fine))).triangles, 1u) << fine;
  }
  const std::string absolute = (outside.path() / "positions.bin").string();
  for (const std::string& uri :
       {std::string("../positions.bin"), std::string("inner/../../positions.bin"), std::string("%2e%2e/positions.bin"),
        std::string("%2E./positions.bin"), absolute, "%2f" + absolute.substr(1), "file://" + absolute,
        std::string("link.bin"), std::string("linked/positions.bin"), std::string("..\\\\positions.bin")}) {
    expect_unreadable(write(uri), {"buffer 0"});
  }
}

}  // namespace
}  // namespace umbrameter
