// References kept between runs: traced once, then read from the user's cache folder.
#pragma once

#include <functional>
#include <optional>
#include <set>
#include <string>

#include "experiments/cache_folder.h"
#include "experiments/console.h"
#include "experiments/reference_key.h"
#include "raytrace/tracer.h"

namespace umbrameter {

/// The folder for references and its limit: 2 GB, or what UMBRAMETER_CACHE_SIZE says ("500M", "10G", "0" for no cache).
/// Nothing, with a note, without a home folder. Throws Error (usage) for a size that is none.
std::optional<CacheFolder> user_cache(const Console& console);

class ReferenceCache {
 public:
  /// Without a folder it always traces.
  ReferenceCache(std::optional<CacheFolder> folder, const Console& console);

  bool enabled() const { return folder_.has_value(); }

  /// The cached result bit for bit, or the traced one, which is then stored. A cache that cannot be used is a note.
  /// Of TracedVisibility and TracedAo.
  template <class Traced>
  Traced get(const ReferenceKey& key, const CacheTitle& title, const std::function<Traced()>& trace);

 private:
  void note_once(const std::string& text);

  std::optional<CacheFolder> folder_;
  Console console_;
  std::set<std::string> noted_;
};

}  // namespace umbrameter
