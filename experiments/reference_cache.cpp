#include "experiments/reference_cache.h"

#include <fmt/format.h>

#include <cstdlib>
#include <string_view>
#include <utility>

#include "core/error.h"
#include "experiments/byte_size.h"

namespace umbrameter {
namespace {

constexpr const char* size_variable = "UMBRAMETER_CACHE_SIZE";

// The parts of each kind of answer, by name: written and read in the same words. Structs are taken apart into all of
// their members, so that none can be forgotten.
template <class Visit>
void visit_parts(TraceStatistics& statistics, const Visit& visit) {
  auto& [rays, seconds, largest_offset, from_cache] = statistics;
  visit("rays", rays);
  visit("seconds", seconds);
  visit("largest_offset_m", largest_offset);
}
template <class Visit>
void visit_parts(SamplingPrecision& precision, const Visit& visit) {
  auto& [pixels, worst_half_width, mean_half_width, mean_samples, pixels_at_limit] = precision;
  visit("pixels", pixels);
  visit("worst_half_width", worst_half_width);
  visit("mean_half_width", mean_half_width);
  visit("mean_samples", mean_samples);
  visit("pixels_at_limit", pixels_at_limit);
}
template <class Visit>
void visit_parts(TracedVisibility& traced, const Visit& visit) {
  auto& [visibility, statistics, standard_error, variance, samples, degrees_of_freedom, precision] = traced;
  visit("visibility", visibility);
  visit("standard_error", standard_error);
  visit("variance", variance);
  visit("samples", samples);
  visit("degrees_of_freedom", degrees_of_freedom);
  visit_parts(precision, visit);
  visit_parts(statistics, visit);
}
template <class Visit>
void visit_parts(TracedAo& traced, const Visit& visit) {
  auto& [ao, standard_error, variance, samples, bent_normal, hit_distance, degrees_of_freedom, precision, statistics] =
      traced;
  visit("ao", ao);
  visit("standard_error", standard_error);
  visit("variance", variance);
  visit("samples", samples);
  visit("bent_normal", bent_normal);
  visit("hit_distance", hit_distance);
  visit("degrees_of_freedom", degrees_of_freedom);
  visit_parts(precision, visit);
  visit_parts(statistics, visit);
}

struct PartWriter {
  CacheEntry& entry;
  template <class T>
  void operator()(const char* name, const Image<T>& image) const {
    entry.images.push_back(to_cached(name, image));
  }
  template <class T>
  void operator()(const char* name, const T& number) const {
    entry.numbers[name] = static_cast<double>(number);
  }
};

// Leaves `whole` false where a part is missing.
struct PartReader {
  const CacheEntry& entry;
  bool& whole;
  template <class T>
  void operator()(const char* name, Image<T>& image) const {
    std::optional<Image<T>> found;
    for (const CachedImage& cached : entry.images) {
      if (cached.name == name) found = from_cached<T>(cached);
    }
    whole = whole && found;
    if (found) image = std::move(*found);
  }
  template <class T>
  void operator()(const char* name, T& number) const {
    const auto found = entry.numbers.find(name);
    whole = whole && found != entry.numbers.end();
    if (found != entry.numbers.end()) number = static_cast<T>(found->second);
  }
};

}  // namespace

std::optional<CacheFolder> user_cache(const Console& console) {
  CacheFolder folder;
  const char* size = std::getenv(size_variable);
  if (size != nullptr && *size != '\0') {
    folder.limit =
        parse_bytes(size, std::string(size_variable) + "=" + size, "write it like 500M or 10G; 0 for no cache");
  }
  const std::optional<std::filesystem::path> base =
      xdg_cache_folder(std::getenv("XDG_CACHE_HOME"), std::getenv("HOME"));
  if (!base) {
    note(console, "references are not cached: neither XDG_CACHE_HOME nor HOME is an absolute path");
    return {};
  }
  folder.path = *base / "references";
  return folder;
}

ReferenceCache::ReferenceCache(std::optional<CacheFolder> folder, const Console& console)
    : folder_(std::move(folder)), console_(console) {
  if (folder_ && folder_->limit == 0) folder_.reset();
}

void ReferenceCache::note_once(const std::string& text) {
  if (noted_.insert(text).second) note(console_, text);
}

template <class Traced>
Traced ReferenceCache::get_any(const ReferenceKey& key, const CacheEntry& about, const std::function<Traced()>& trace) {
  if (!folder_) return trace();
  const std::string text = to_text(key);
  CacheRead read = load_entry(*folder_, text);
  if (read.entry) {
    Traced traced;
    bool whole = true;
    visit_parts(traced, PartReader{*read.entry, whole});
    if (whole) {
      traced.statistics.from_cache = true;
      note_once(fmt::format("{}: using the cached reference ({} rays, traced in {:.3g} s)", about.what,
                            traced.statistics.rays, traced.statistics.seconds));
      return traced;
    }
    read.problem = "parts of an entry are missing";
  }
  if (!read.problem.empty()) note_once("a cached reference is damaged and is traced again: " + read.problem);
  Traced traced = trace();
  CacheEntry entry = about;
  visit_parts(traced, PartWriter{entry});
  const std::string problem = store_entry(*folder_, text, entry);
  if (!problem.empty()) note_once("a reference could not be cached: " + problem);
  return traced;
}

TracedVisibility ReferenceCache::get(const ReferenceKey& key, const CacheEntry& about,
                                     const std::function<TracedVisibility()>& trace) {
  return get_any<TracedVisibility>(key, about, trace);
}
TracedAo ReferenceCache::get(const ReferenceKey& key, const CacheEntry& about, const std::function<TracedAo()>& trace) {
  return get_any<TracedAo>(key, about, trace);
}

}  // namespace umbrameter
