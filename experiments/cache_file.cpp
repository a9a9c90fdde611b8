#include "experiments/cache_file.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <new>
#include <nlohmann/json.hpp>
#include <span>
#include <stdexcept>

#include "core/parameters.h"
#include "experiments/content_hash.h"

namespace umbrameter {
namespace {

using Json = nlohmann::ordered_json;

// Numbers in the order of the machine's own bytes: read on a machine with the other order, the version does not fit.
struct Head {
  std::array<char, 8> magic{'U', 'M', 'B', 'R', 'A', 'R', 'E', 'F'};
  std::uint32_t version = 2;
  std::uint32_t reserved = 0;
  std::uint64_t text_bytes = 0;
  std::uint64_t pixel_bytes = 0;    // as they lie in the file: compressed
  std::array<char, 32> checksum{};  // of all that follows the head, and of the sizes before
};
static_assert(sizeof(Head) == 64);

std::array<char, 32> checksum_of(const Head& head, std::string_view text, std::string_view pixels) {
  ContentHash hash;
  hash.add(head.version).add(head.reserved).add(head.text_bytes).add(head.pixel_bytes).add(text);
  hash.add_bytes(std::as_bytes(std::span(pixels.data(), pixels.size())));
  std::array<char, 32> digits{};
  hash.hex().copy(digits.data(), digits.size());
  return digits;
}

std::string_view view_of(const CachedImage& image) {
  return {reinterpret_cast<const char*>(image.pixels.data()), image.pixels.size()};
}

// Numbers as text, because JSON has neither infinities nor NaN.
Json describe_entry(const std::string& key, const CacheEntry& entry) {
  Json text = {{"key", key}, {"scene", entry.scene}, {"what", entry.what}};
  text["images"] = Json::array();
  for (const CachedImage& image : entry.images) {
    text["images"].push_back(
        {{"name", image.name}, {"width", image.width}, {"height", image.height}, {"pixel_bytes", image.pixel_bytes}});
  }
  text["numbers"] = Json::object();
  for (const auto& [name, number] : entry.numbers) text["numbers"][name] = to_string(Value(number));
  return text;
}

double number_of(const std::string& text) {
  double number = 0.0;
  const char* end = text.data() + text.size();
  if (std::from_chars(text.data(), end, number).ptr != end) throw std::invalid_argument("no number");
  return number;
}

CacheEntry entry_of(const Json& text) {
  CacheEntry entry;
  entry.scene = text.at("scene").get<std::string>();
  entry.what = text.at("what").get<std::string>();
  for (const Json& image : text.at("images")) {
    entry.images.push_back({image.at("name").get<std::string>(),
                            image.at("width").get<int>(),
                            image.at("height").get<int>(),
                            image.at("pixel_bytes").get<int>(),
                            {}});
  }
  for (const auto& [name, number] : text.at("numbers").items()) {
    entry.numbers[name] = number_of(number.get<std::string>());
  }
  return entry;
}

// zlib's fastest level: shadows and open sky shrink to a few hundredths, noise of sampled images hardly more by slower
// ones. Of all images as one stream, whose parts are given to zlib one after the other.
std::string compress(const std::vector<CachedImage>& images) {
  z_stream stream{};
  if (deflateInit(&stream, Z_BEST_SPEED) != Z_OK) throw std::bad_alloc();
  std::string out;
  std::array<char, 1 << 16> block;
  const auto feed = [&](std::string_view part, int flush) {
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(part.data()));
    stream.avail_in = static_cast<uInt>(part.size());
    do {
      stream.next_out = reinterpret_cast<Bytef*>(block.data());
      stream.avail_out = static_cast<uInt>(block.size());
      deflate(&stream, flush);
      out.append(block.data(), block.size() - stream.avail_out);
    } while (stream.avail_out == 0);
  };
  constexpr std::size_t max_at_once = 1u << 30;  // zlib counts in 32 bits
  for (const CachedImage& image : images) {
    for (std::string_view rest = view_of(image); !rest.empty();) {
      feed(rest.substr(0, max_at_once), Z_NO_FLUSH);
      rest.remove_prefix(std::min(rest.size(), max_at_once));
    }
  }
  feed({}, Z_FINISH);
  deflateEnd(&stream);
  return out;
}

// Fills the images; false where the stream does not hold exactly what they take.
bool expand(CacheEntry& entry, std::string_view pixels) {
  // A stream cannot grow by more (zlib, Technical Details): sizes beyond that are never allocated.
  constexpr std::uint64_t max_growth = 1032;
  std::uint64_t room = (pixels.size() + 1) * max_growth;
  for (CachedImage& image : entry.images) {
    if (image.width < 0 || image.height < 0 || image.pixel_bytes < 0) return false;
    const std::uint64_t area = static_cast<std::uint64_t>(image.width) * static_cast<std::uint64_t>(image.height);
    const auto pixel = static_cast<std::uint64_t>(image.pixel_bytes);
    if (pixel != 0 && area > room / pixel) return false;
    room -= area * pixel;
    image.pixels.resize(static_cast<std::size_t>(area * pixel));
  }
  z_stream stream{};
  if (inflateInit(&stream) != Z_OK) throw std::bad_alloc();
  int state = Z_OK;
  const auto take = [&](std::byte* into, std::size_t bytes) {
    constexpr std::size_t max_at_once = 1u << 30;
    while (bytes > 0 && state == Z_OK) {
      const std::size_t part = std::min(bytes, max_at_once);
      const std::size_t given = std::min(pixels.size(), max_at_once);
      stream.next_out = reinterpret_cast<Bytef*>(into);
      stream.avail_out = static_cast<uInt>(part);
      stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(pixels.data()));
      stream.avail_in = static_cast<uInt>(given);
      state = inflate(&stream, Z_NO_FLUSH);
      pixels.remove_prefix(given - stream.avail_in);
      into += part - stream.avail_out;
      bytes -= part - stream.avail_out;
      if (part == stream.avail_out && given == stream.avail_in) break;  // no way on
    }
    return bytes == 0;
  };
  bool is_whole = true;
  for (CachedImage& image : entry.images) is_whole = is_whole && take(image.pixels.data(), image.pixels.size());
  // Nothing may be left but the stream's own end.
  std::byte beyond{};
  is_whole = is_whole && !take(&beyond, 1) && state == Z_STREAM_END && pixels.empty();
  inflateEnd(&stream);
  return is_whole;
}

// The head where magic and version fit and the whole file is there.
std::string read_head(std::string_view bytes, Head& head) {
  if (bytes.size() < sizeof(Head)) return "it is too short";
  std::memcpy(&head, bytes.data(), sizeof(Head));
  if (head.magic != Head{}.magic) return "it is not a cached reference";
  if (head.version != Head{}.version) return "it has another format version";
  return {};
}

}  // namespace

std::string to_cache_file(const std::string& key, const CacheEntry& entry) {
  // Names come from files: bytes that are no UTF-8 are replaced, never thrown on.
  const std::string text = describe_entry(key, entry).dump(-1, ' ', false, Json::error_handler_t::replace);
  const std::string pixels = compress(entry.images);
  Head head;
  head.text_bytes = text.size();
  head.pixel_bytes = pixels.size();
  head.checksum = checksum_of(head, text, pixels);
  std::string bytes(reinterpret_cast<const char*>(&head), sizeof(Head));
  bytes.reserve(sizeof(Head) + text.size() + pixels.size());
  return bytes += text + pixels;
}

CacheRead from_cache_file(const std::string& key, std::string_view bytes) {
  Head head;
  if (std::string problem = read_head(bytes, head); !problem.empty()) return {{}, std::move(problem)};
  bytes.remove_prefix(sizeof(Head));
  if (head.text_bytes > bytes.size() || head.pixel_bytes != bytes.size() - head.text_bytes) {
    return {{}, "it has the wrong length"};
  }
  const std::string_view text = bytes.substr(0, head.text_bytes);
  const std::string_view pixels = bytes.substr(head.text_bytes);
  if (checksum_of(head, text, pixels) != head.checksum) return {{}, "its checksum is wrong"};
  const Json json = Json::parse(text, nullptr, false);
  try {
    if (json.at("key") != key) return {{}, "it belongs to another reference"};
    CacheEntry entry = entry_of(json);
    if (!expand(entry, pixels)) return {{}, "its images have the wrong size"};
    return {std::move(entry), {}};
  } catch (const std::exception&) {
    return {{}, "its contents are incomplete"};
  }
}

std::optional<CacheEntry> peek_cache_file(std::string_view head_bytes) {
  Head head;
  if (!read_head(head_bytes, head).empty()) return {};
  head_bytes.remove_prefix(sizeof(Head));
  if (head.text_bytes > head_bytes.size()) return {};
  const Json json = Json::parse(head_bytes.substr(0, head.text_bytes), nullptr, false);
  try {
    return entry_of(json);
  } catch (const std::exception&) {
    return {};
  }
}

}  // namespace umbrameter
