// Broken files by the thousand: every construct cut short, with flipped bits, and with each value of its text replaced.
// Each gives a Scene or one line of Error, soon and within a stated multiple of memory.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdlib>
#include <functional>
#include <mutex>
#include <new>
#include <random>

#include "core/error.h"
#include "core/parallel.h"
#include "scenes/gltf.h"
#include "tests/support/gltf_constructs.h"
#include "tests/support/json_values.h"

namespace {

// What this thread holds through operator new: a file is read by one thread.
thread_local std::ptrdiff_t held_bytes = 0;
thread_local std::ptrdiff_t most_bytes = 0;

// The size stands before the block.
constexpr std::size_t head = alignof(std::max_align_t);

void* counted_or_null(std::size_t size) noexcept {
  void* block = std::malloc(size + head);
  if (block == nullptr) return nullptr;
  *static_cast<std::size_t*>(block) = size;
  held_bytes += static_cast<std::ptrdiff_t>(size);
  most_bytes = std::max(most_bytes, held_bytes);
  return static_cast<std::byte*>(block) + head;
}

void* counted(std::size_t size) {
  void* memory = counted_or_null(size);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

void uncounted(void* memory) noexcept {
  if (memory == nullptr) return;
  void* block = static_cast<std::byte*>(memory) - head;
  held_bytes -= static_cast<std::ptrdiff_t>(*static_cast<std::size_t*>(block));
  std::free(block);
}

}  // namespace

void* operator new(std::size_t size) { return counted(size); }
void* operator new[](std::size_t size) { return counted(size); }
// A sanitizer brings forms of its own that throw nothing, and do not call those above.
void* operator new(std::size_t size, const std::nothrow_t&) noexcept { return counted_or_null(size); }
void* operator new[](std::size_t size, const std::nothrow_t&) noexcept { return counted_or_null(size); }
void operator delete(void* memory) noexcept { uncounted(memory); }
void operator delete[](void* memory) noexcept { uncounted(memory); }
void operator delete(void* memory, std::size_t) noexcept { uncounted(memory); }
void operator delete[](void* memory, std::size_t) noexcept { uncounted(memory); }
void operator delete(void* memory, const std::nothrow_t&) noexcept { uncounted(memory); }
void operator delete[](void* memory, const std::nothrow_t&) noexcept { uncounted(memory); }

namespace umbrameter::test {
namespace {

// The limit, as much again for what is held twice while it is read, and the file and its text.
constexpr std::ptrdiff_t limit_bytes = std::ptrdiff_t{256} << 20;
constexpr std::ptrdiff_t base_bytes = 2 * limit_bytes;
constexpr std::ptrdiff_t bytes_per_byte = 128;
constexpr double most_seconds = 10.0;

/// Why a file is not dealt with as promised; empty when it is.
std::string complaint(std::span<const unsigned char> bytes) {
  held_bytes = 0;
  most_bytes = 0;
  const auto start = std::chrono::steady_clock::now();
  std::string text;
  try {
    read_gltf(bytes, "folder-that-is-not-there/scene.gltf", "", {.memory = limit_bytes});
  } catch (const Error& error) {
    const std::string_view message = error.what();
    if (error.code() != ExitCode::unreadable_input) text = "code of: " + std::string(message);
    if (message.find('\n') != std::string_view::npos) text = "more than a line: " + std::string(message);
  } catch (const std::exception& error) {
    text = std::string("not an Error: ") + error.what();
  }
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
  if (spent.count() > most_seconds) text += " took " + std::to_string(spent.count()) + " s";
  if (most_bytes > base_bytes + bytes_per_byte * std::ssize(bytes)) {
    text += " took " + std::to_string(most_bytes) + " bytes";
  }
  return text;
}

using Try = std::function<void(const Bytes& bytes, const std::string& what)>;

/// Runs a family of mutants over every construct, on all cores.
void expect_no_complaint(const std::function<void(const Construct&, const Try&)>& family) {
  const std::vector<Construct> all = all_constructs();
  std::mutex mutex;
  std::size_t tried = 0;
  std::vector<std::string> complaints;
  parallel_for(all.size(), [&](std::size_t i) {
    const Construct& construct = all[i];
    std::size_t number = 0;
    family(construct, [&](const Bytes& bytes, const std::string& what) {
      ++number;
      const std::string text = complaint(bytes);
      const std::lock_guard lock(mutex);
      if (!text.empty()) complaints.push_back(construct.name + ", " + what + ": " + text);
    });
    const std::lock_guard lock(mutex);
    tried += number;
  });
  EXPECT_GT(tried, 1000u);
  EXPECT_EQ(complaints.size(), 0u) << "of " << tried;
  for (std::size_t i = 0; i < std::min<std::size_t>(complaints.size(), 10); ++i) ADD_FAILURE() << complaints[i];
}

/// The JSON text of a construct, and the file around another text.
std::string text_of(const Construct& construct) {
  const Bytes& file = construct.file;
  if (file.front() == '{') return {file.begin(), file.end()};
  const std::size_t length = file[12] | (std::size_t{file[13]} << 8u) | (std::size_t{file[14]} << 16u);
  return {file.begin() + 20, file.begin() + 20 + static_cast<std::ptrdiff_t>(length)};
}

Bytes with_text(const Construct& construct, const std::string& json) {
  if (construct.file.front() == '{') return {json.begin(), json.end()};
  const std::size_t binary = 28 + text_of(construct).size();
  if (binary >= construct.file.size()) return pack_glb(json, {});
  return pack_glb(json, {construct.file.begin() + static_cast<std::ptrdiff_t>(binary), construct.file.end()});
}

/// At most `most` of the values, evenly spread.
std::vector<JsonValue> some(std::vector<JsonValue> values, std::size_t most) {
  const std::size_t step = (values.size() + most - 1) / most;
  std::vector<JsonValue> chosen;
  for (std::size_t i = 0; i < values.size(); i += step) chosen.push_back(values[i]);
  return chosen;
}

std::vector<JsonValue> numbers_of(std::string_view json) {
  std::vector<JsonValue> values = json_values(json);
  std::erase_if(values, [](const JsonValue& value) { return value.kind != JsonValue::Kind::number; });
  return values;
}

TEST(GltfMutants, Files_cut_short_anywhere_are_errors_or_scenes) {
  expect_no_complaint([](const Construct& construct, const Try& attempt) {
    const std::size_t step = construct.file.size() / 400 + 1;
    for (std::size_t size = 0; size < construct.file.size(); size += step) {
      attempt({construct.file.begin(), construct.file.begin() + static_cast<std::ptrdiff_t>(size)},
              "cut to " + std::to_string(size) + " bytes");
    }
  });
}

TEST(GltfMutants, Flipped_bits_are_errors_or_scenes) {
  expect_no_complaint([](const Construct& construct, const Try& attempt) {
    std::minstd_rand random(7);
    for (int i = 0; i < 200; ++i) {
      Bytes bytes = construct.file;
      const std::size_t bit = random() % (8 * bytes.size());
      bytes[bit / 8] = static_cast<unsigned char>(bytes[bit / 8] ^ (1u << (bit % 8)));
      attempt(bytes, "bit " + std::to_string(bit));
    }
  });
}

TEST(GltfMutants, Any_number_in_place_of_any_number_is_an_error_or_a_scene) {
  constexpr std::array<std::string_view, 10> replacements = {
      "-1",    "0",     "2147483647", "2147483648",    "4294967296",
      "1e300", "1e999", "0.5",        "1099511627776", "18446744073709551616"};
  expect_no_complaint([&](const Construct& construct, const Try& attempt) {
    const std::string json = text_of(construct);
    for (const JsonValue& value : some(numbers_of(json), 40)) {
      for (const std::string_view replacement : replacements) {
        attempt(with_text(construct, with_value(json, value, replacement)),
                std::string(replacement) + " at " + std::to_string(value.begin));
      }
    }
  });
}

TEST(GltfMutants, Any_kind_of_value_in_place_of_any_other_is_an_error_or_a_scene) {
  constexpr std::array<std::string_view, 6> replacements = {"null", "\"text\"", "[]", "{}", "true", "7"};
  expect_no_complaint([&](const Construct& construct, const Try& attempt) {
    const std::string json = text_of(construct);
    for (const JsonValue& value : some(json_values(json), 50)) {
      for (const std::string_view replacement : replacements) {
        attempt(with_text(construct, with_value(json, value, replacement)),
                std::string(replacement) + " at " + std::to_string(value.begin));
      }
      attempt(with_text(construct, without_value(json, value)), "nothing at " + std::to_string(value.begin));
    }
  });
}

TEST(GltfMutants, Two_numbers_exchanged_are_an_error_or_a_scene) {
  expect_no_complaint([](const Construct& construct, const Try& attempt) {
    const std::string json = text_of(construct);
    const std::vector<JsonValue> numbers = some(numbers_of(json), 24);
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      for (std::size_t k = i + 1; k < numbers.size(); ++k) {
        const std::string second = json.substr(numbers[i].begin, numbers[i].end - numbers[i].begin);
        const std::string first = json.substr(numbers[k].begin, numbers[k].end - numbers[k].begin);
        if (first == second) continue;
        const std::string half = with_value(json, numbers[k], second);
        attempt(with_text(construct, with_value(half, numbers[i], first)),
                "numbers at " + std::to_string(numbers[i].begin) + " and " + std::to_string(numbers[k].begin));
      }
    }
  });
}

TEST(JsonValues, Members_and_items_are_found_replaced_and_taken_out) {
  const std::string json = R"({"a":[1, -2.5e3,{"b":"x\"y"}],"c":true})";
  const std::vector<JsonValue> values = json_values(json);
  std::vector<std::string> texts;
  for (const JsonValue& value : values) texts.push_back(json.substr(value.begin, value.end - value.begin));
  EXPECT_EQ(texts, (std::vector<std::string>{json, R"([1, -2.5e3,{"b":"x\"y"}])", "1", "-2.5e3", R"({"b":"x\"y"})",
                                             R"("x\"y")", "true"}));
  EXPECT_EQ(with_value(json, values[2], "null"), R"({"a":[null, -2.5e3,{"b":"x\"y"}],"c":true})");
  EXPECT_EQ(without_value(json, values[1]), R"({"c":true})");
  EXPECT_EQ(without_value(json, values[4]), R"({"a":[1, -2.5e3],"c":true})");
  EXPECT_EQ(without_value(json, values[6]), R"({"a":[1, -2.5e3,{"b":"x\"y"}]})");
}

}  // namespace
}  // namespace umbrameter::test
