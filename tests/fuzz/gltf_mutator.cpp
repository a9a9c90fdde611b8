// Mutates the JSON text and the binary chunk of a glTF file apart from one another, and makes a whole file of them
// again, so that most mutants get past the container and the parser.
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <optional>
#include <random>
#include <string>

#include "tests/support/gltf_builder.h"
#include "tests/support/json_values.h"

// libFuzzer's interface has no header of its own.
extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                               unsigned int seed);

namespace umbrameter::test {
namespace {

using Random = std::minstd_rand;

struct Parts {
  std::string json;
  Bytes binary;
  bool is_binary = false;
};

std::size_t word(const std::uint8_t* data) {
  std::size_t value = 0;
  for (std::size_t i = 4; i-- > 0;) value = (value << 8u) | data[i];
  return value;
}

std::optional<Parts> taken_apart(const std::uint8_t* data, std::size_t size) {
  Parts parts;
  if (size < 20 || std::memcmp(data, "glTF", 4) != 0) {
    parts.json.assign(reinterpret_cast<const char*>(data), size);
    return size != 0 && data[0] == '{' ? std::optional(parts) : std::nullopt;
  }
  parts.is_binary = true;
  const std::size_t length = word(data + 12);
  if (length > size - 20) return std::nullopt;
  parts.json.assign(reinterpret_cast<const char*>(data) + 20, length);
  if (size - 20 - length > 8) parts.binary.assign(data + 28 + length, data + size);
  return parts;
}

template <class Bytelike>
void mutate_bytes(Bytelike& bytes, std::size_t room) {
  std::vector<std::uint8_t> buffer(bytes.begin(), bytes.end());
  buffer.resize(bytes.size() + room);
  if (buffer.empty()) return;
  buffer.resize(LLVMFuzzerMutate(buffer.data(), bytes.size(), buffer.size()));
  bytes.assign(buffer.begin(), buffer.end());
}

constexpr std::array<std::string_view, 26> numbers = {
    "-1",   "0",          "1",          "2",          "3",     "4",     "5",     "7",    "8",
    "12",   "16",         "255",        "256",        "65535", "65536", "5120",  "5121", "5123",
    "5126", "2147483647", "4294967295", "4294967296", "1e300", "-0.5",  "1e-40", "0.5"};
constexpr std::array<std::string_view, 7> other_kinds = {"null", "true", "\"MASK\"", "[]", "{}", "\"\"", "[0,0,0]"};

template <class Items>
const auto& one_of(const Items& items, Random& random) {
  return items[random() % items.size()];
}

void change_number(std::string& json, const std::vector<JsonValue>& values, Random& random) {
  for (int tries = 0; tries < 16; ++tries) {
    const JsonValue& value = one_of(values, random);
    if (value.kind != JsonValue::Kind::number) continue;
    json = with_value(json, value, random() % 3 == 0 ? std::to_string(random() % 40) : one_of(numbers, random));
    return;
  }
}

void mutate_json(std::string& json, Random& random) {
  const std::vector<JsonValue> values = json_values(json);
  if (values.empty()) return mutate_bytes(json, 16);
  const JsonValue& value = one_of(values, random);
  const JsonValue& other = one_of(values, random);
  const auto text_of = [&](std::size_t begin, std::size_t end) { return json.substr(begin, end - begin); };
  switch (random() % 8) {
    case 0:
    case 1:
    case 2:
      return change_number(json, values, random);
    case 3:
      json = with_value(json, value, one_of(other_kinds, random));
      return;
    case 4:
      json = without_value(json, value);
      return;
    case 5:
      json = with_value(json, value, text_of(other.begin, other.end));
      return;
    case 6:  // the member or item twice
      if (value.start != 0) json.insert(value.end, "," + text_of(value.start, value.end));
      return;
    default:
      return mutate_bytes(json, 16);
  }
}

}  // namespace
}  // namespace umbrameter::test

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                               unsigned int seed) {
  using namespace umbrameter::test;
  Random random(seed + 1);
  std::optional<Parts> parts = random() % 16 == 0 ? std::nullopt : taken_apart(data, size);
  if (!parts) return LLVMFuzzerMutate(data, size, max_size);
  const std::size_t room = std::min<std::size_t>(max_size - size, 4096);
  if (!parts->binary.empty() && random() % 5 < 2) {
    mutate_bytes(parts->binary, room / 2);
  } else {
    for (auto left = 1 + random() % 3; left > 0; --left) mutate_json(parts->json, random);
  }
  const Bytes whole =
      parts->is_binary ? pack_glb(parts->json, parts->binary) : Bytes(parts->json.begin(), parts->json.end());
  if (whole.size() > max_size) return LLVMFuzzerMutate(data, size, max_size);
  std::copy(whole.begin(), whole.end(), data);
  return whole.size();
}
