// Caches references between runs in the user's cache folder.
#pragma once

#include <functional>
#include <optional>
#include <set>
#include <string>

#include "experiments/stages/cache_folder.h"
#include "experiments/stages/reference_key.h"
#include "raytrace/tracer.h"
#include "reports/files/console.h"

namespace umbrameter {

/// The folder for references, UMBRAMETER_CACHE or that of xdg_cache_folder(), and its limit: 2 GB, or
/// UMBRAMETER_CACHE_SIZE ("500M", "10G", "0" for no cache). Empty, with a note, if there is no home folder. Throws
/// Error (usage) for a malformed size.
std::optional<CacheFolder> user_cache(const Console& console);

/// ", camera arcade"; empty if the camera has no name.
std::string of_camera(const View& view);

class ReferenceCache {
 public:
  /// Without a folder, get() always traces.
  ReferenceCache(std::optional<CacheFolder> folder, const Console& console);

  bool enabled() const { return folder_.has_value(); }

  /// Returns the cached result, bit for bit, or traces it and stores it. Prints a note if the cache cannot be used.
  /// Traced is TracedVisibility or TracedAo.
  template <class Traced>
  Traced get(const ReferenceKey& key, const CacheTitle& title, const std::function<Traced()>& trace);

 private:
  void note_once(const std::string& text);

  std::optional<CacheFolder> folder_;
  Console console_;
  std::set<std::string> noted_;
};

}  // namespace umbrameter
