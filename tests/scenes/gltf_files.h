// Small glTF files put together by hand, for the tests of the reader.
#pragma once

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "core/error.h"
#include "scenes/gltf.h"
#include "tests/support/temporary_folder.h"

namespace umbrameter::test {

using Bytes = std::vector<unsigned char>;

using umbrameter::TemporaryFolder;

template <class T>
void append(Bytes& bytes, const std::vector<T>& values) {
  const std::size_t offset = bytes.size();
  bytes.resize(offset + values.size() * sizeof(T));
  std::memcpy(bytes.data() + offset, values.data(), values.size() * sizeof(T));
}

template <class T>
Bytes bytes_of(const std::vector<T>& values) {
  Bytes bytes;
  append(bytes, values);
  return bytes;
}

inline Bytes glb(std::string json, Bytes binary) {
  json.resize((json.size() + 3) / 4 * 4, ' ');
  binary.resize((binary.size() + 3) / 4 * 4);
  Bytes bytes;
  const auto word = [&](std::size_t value) { append<std::uint32_t>(bytes, {static_cast<std::uint32_t>(value)}); };
  word(0x46546C67);
  word(2);
  word(12 + 8 + json.size() + (binary.empty() ? 0 : 8 + binary.size()));
  word(json.size());
  word(0x4E4F534A);
  bytes.insert(bytes.end(), json.begin(), json.end());
  if (binary.empty()) return bytes;
  word(binary.size());
  word(0x004E4942);
  bytes.insert(bytes.end(), binary.begin(), binary.end());
  return bytes;
}

inline std::string base64(const Bytes& bytes) {
  const std::string alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t bits = static_cast<std::uint32_t>(bytes[i]) << 16u;
    if (i + 1 < bytes.size()) bits |= static_cast<std::uint32_t>(bytes[i + 1]) << 8u;
    if (i + 2 < bytes.size()) bits |= bytes[i + 2];
    text += alphabet[bits >> 18u];
    text += alphabet[(bits >> 12u) & 63u];
    text += i + 1 < bytes.size() ? alphabet[(bits >> 6u) & 63u] : '=';
    text += i + 2 < bytes.size() ? alphabet[bits & 63u] : '=';
  }
  return text;
}

/// The right triangle (0,0,0) (1,0,0) (0,1,0) as 36 bytes of positions.
inline Bytes triangle_positions() { return bytes_of<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}); }

/// A file whose only mesh is that triangle, without indices; `nodes` and `more` are JSON members.
inline std::string triangle_json(const std::string& nodes = R"("nodes":[{"mesh":0}])", const std::string& more = "",
                                 const std::string& buffer = R"({"byteLength":36})") {
  return R"({"asset":{"version":"2.0"},)" + nodes + (more.empty() ? "" : "," + more) + R"(,"buffers":[)" + buffer +
         R"(],"bufferViews":[{"buffer":0,"byteLength":36}],)"
         R"("accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],)"
         R"("meshes":[{"name":"tri","primitives":[{"attributes":{"POSITION":0}}]}]})";
}

inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

/// The triangle with one piece of its text exchanged.
inline Bytes broken(const std::string& from, const std::string& to) {
  return glb(replaced(triangle_json(), from, to), triangle_positions());
}

inline Scene load(const TemporaryFolder& folder, const Bytes& bytes) {
  return load_gltf(folder.write("test.glb", bytes), {}, {.materials = true});
}

/// Expects one Error (unreadable_input), one line, that holds each of the words.
inline void expect_unreadable(const std::filesystem::path& path, const std::vector<std::string>& words) {
  try {
    load_gltf(path);
    ADD_FAILURE() << path << " was read";
  } catch (const Error& error) {
    const std::string text = error.what();
    EXPECT_EQ(error.code(), ExitCode::unreadable_input) << text;
    EXPECT_EQ(text.find('\n'), std::string::npos) << text;
    EXPECT_NE(text.find(path.string()), std::string::npos) << text;
    for (const std::string& word : words) EXPECT_NE(text.find(word), std::string::npos) << word << " in: " << text;
  }
}

inline void expect_unreadable(const Bytes& bytes, const std::vector<std::string>& words) {
  const TemporaryFolder folder;
  expect_unreadable(folder.write("test.glb", bytes), words);
}

}  // namespace umbrameter::test
