#include "experiments/stages/reference_cache.h"

#include <fmt/format.h>

#include <cstdlib>
#include <cstring>
#include <string_view>
#include <type_traits>
#include <utility>

#include "experiments/stages/byte_size.h"
#include "reports/files/text_layout.h"

namespace umbrameter {
namespace {

constexpr const char* folder_variable = "UMBRAMETER_CACHE";
constexpr const char* size_variable = "UMBRAMETER_CACHE_SIZE";

// The members of each kind of result, as references. The structured binding names every member, so a new member does
// not compile until it is listed here.
auto members(TracedVisibility& traced) {
  auto& [visibility, statistics, standard_error, variance, samples, degrees_of_freedom, precision] = traced;
  return std::tie(visibility, statistics, standard_error, variance, samples, degrees_of_freedom, precision);
}
auto members(TracedAo& traced) {
  auto& [ao, standard_error, variance, samples, bent_normal, hit_distance, degrees_of_freedom, precision, statistics] =
      traced;
  return std::tie(ao, standard_error, variance, samples, bent_normal, hit_distance, degrees_of_freedom, precision,
                  statistics);
}

// The bytes of each member, one after the other. They need neither names nor a version: the key contains the hash of
// the program, so that no other program reads them.
struct Writer {
  const std::function<void(std::string_view)>& write;
  template <class T>
  void bytes(const T* values, std::size_t count) {
    static_assert(std::is_trivially_copyable_v<T>);
    write({reinterpret_cast<const char*>(values), count * sizeof(T)});
  }
  template <class T>
  void operator()(const T& value) {
    bytes(&value, 1);
  }
  template <class T>
  void operator()(const Image<T>& image) {
    bytes(&image.width, 1);
    bytes(&image.height, 1);
    bytes(image.pixels.data(), image.size());
  }
};

// Leaves `is_whole` false where bytes are missing.
struct Reader {
  std::string_view rest;
  bool is_whole = true;
  void copy(void* to, std::size_t bytes) {
    is_whole = is_whole && bytes <= rest.size();
    if (!is_whole || bytes == 0) return;
    std::memcpy(to, rest.data(), bytes);
    rest.remove_prefix(bytes);
  }
  template <class T>
  void operator()(T& value) {
    copy(&value, sizeof(T));
  }
  template <class T>
  void operator()(Image<T>& image) {
    int width = 0;
    int height = 0;
    (*this)(width);
    (*this)(height);
    if (static_cast<std::size_t>(width) * static_cast<std::size_t>(height) > rest.size() / sizeof(T)) is_whole = false;
    if (!is_whole) return;
    image = Image<T>(width, height);
    copy(image.pixels.data(), image.size() * sizeof(T));
  }
};

template <class Traced, class Visit>
void visit_members(Traced& traced, Visit& visit) {
  std::apply([&](auto&... member) { (visit(member), ...); }, members(traced));
}

}  // namespace

std::optional<CacheFolder> user_cache(const Console& console) {
  CacheFolder folder;
  const char* size = std::getenv(size_variable);
  if (size != nullptr && *size != '\0') {
    folder.limit =
        parse_bytes(size, std::string(size_variable) + "=" + size, "write it like 500M or 10G; 0 for no cache");
  }
  if (const char* shared = std::getenv(folder_variable); shared != nullptr && *shared != '\0') {
    folder.path = std::filesystem::absolute(shared);
    return folder;
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

std::string of_camera(const View& view) {
  return view.camera.name.empty() ? std::string() : ", camera " + shortened(view.camera.name, 40);
}

void ReferenceCache::note_once(const std::string& text) {
  if (noted_.insert(text).second) note(console_, text);
}

template <class Traced>
Traced ReferenceCache::get(const ReferenceKey& key, const CacheTitle& title, const std::function<Traced()>& trace) {
  if (!folder_) return trace();
  const std::string text = to_text(key);
  const CacheRead read = load_entry(*folder_, text);
  if (read.content) {
    Traced traced;
    Reader reader{*read.content};
    visit_members(traced, reader);
    if (reader.is_whole && reader.rest.empty()) {
      traced.statistics.from_cache = true;
      note_once(fmt::format("{}, {}: using the cached reference ({} rays, traced in {:.2g} s)", title.scene, title.what,
                            grouped(traced.statistics.rays), traced.statistics.seconds));
      return traced;
    }
  }
  if (!read.problem.empty()) note_once("a cached reference is damaged and is traced again: " + read.problem);
  Traced traced = trace();
  const std::string problem = store_entry(*folder_, text, title, [&](const auto& write) {
    Writer writer{write};
    visit_members(traced, writer);
  });
  if (!problem.empty()) note_once("a reference could not be cached: " + problem);
  return traced;
}

template TracedVisibility ReferenceCache::get(const ReferenceKey&, const CacheTitle&,
                                              const std::function<TracedVisibility()>&);
template TracedAo ReferenceCache::get(const ReferenceKey&, const CacheTitle&, const std::function<TracedAo()>&);

}  // namespace umbrameter
