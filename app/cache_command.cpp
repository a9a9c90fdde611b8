#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "app/commands.h"
#include "app/print_json.h"
#include "experiments/stages/reference_cache.h"
#include "reports/files/text_layout.h"

namespace umbrameter {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t name_characters = 32;
constexpr std::size_t reference_characters = 160;
constexpr std::size_t key_characters = 12;

double seconds_since(std::filesystem::file_time_type time) {
  const auto elapsed = std::filesystem::file_time_type::clock::now() - time;
  return std::max(std::chrono::duration<double>(elapsed).count(), 0.0);
}

std::string age_text(double seconds) {
  if (seconds < 90.0) return fmt::format("{:.0f} s ago", seconds);
  if (seconds < 90.0 * 60.0) return fmt::format("{:.0f} min ago", seconds / 60.0);
  if (seconds < 36.0 * 3600.0) return fmt::format("{:.0f} h ago", seconds / 3600.0);
  return fmt::format("{:.0f} days ago", seconds / 86400.0);
}

Json to_json(const CacheListing& listing) {
  return {{"key", listing.name},
          {"scene", listing.title ? Json(listing.title->scene) : Json(nullptr)},
          {"what", listing.title ? Json(listing.title->what) : Json(nullptr)},
          {"bytes", listing.bytes},
          {"used_seconds_ago", std::round(seconds_since(listing.used))}};
}

// The reference last: the ends of names tell a hard shadow from a soft one.
std::vector<std::string> to_row(const CacheListing& listing) {
  return {listing.title ? shortened(listing.title->scene, name_characters) : "(damaged)", bytes_text(listing.bytes),
          age_text(seconds_since(listing.used)), listing.name.substr(0, key_characters),
          listing.title ? shortened(listing.title->what, reference_characters) : ""};
}

ExitCode clear(const CacheFolder& folder, const Console& console) {
  const ClearedCache cleared = clear_entries(folder);
  print_line(console, fmt::format("{} references removed, {}", cleared.entries, bytes_text(cleared.bytes)));
  print_json(console, {{"folder", folder.path.string()},
                       {"removed", cleared.entries},
                       {"removed_bytes", cleared.bytes},
                       {"left", cleared.left}});
  if (cleared.left == 0) return ExitCode::ok;
  throw Error(ExitCode::partial, folder.path.string(), fmt::format("{} references cannot be removed", cleared.left),
              "check the folder's permissions");
}

}  // namespace

ExitCode run_cache(const CommandLine& line, const Console& console) {
  const std::optional<CacheFolder> folder = user_cache(console);
  if (!folder) {
    print_json(console, {{"folder", nullptr}, {"entries", Json::array()}});
    return ExitCode::ok;
  }
  if (line.clear) return clear(*folder, console);
  Json entries = Json::array();
  std::vector<std::vector<std::string>> rows = {{"scene", "size", "used", "key", "reference"}};
  std::uint64_t total = 0;
  for (const CacheListing& listing : list_entries(*folder)) {
    total += listing.bytes;
    entries.push_back(to_json(listing));
    rows.push_back(to_row(listing));
  }
  if (!entries.empty()) {
    for (const std::string& text : aligned(rows)) print_line(console, text);
  }
  print_line(console, fmt::format("{}: {} references, {} of {}", folder->path.string(), entries.size(),
                                  bytes_text(total), bytes_text(folder->limit)));
  print_json(
      console,
      {{"folder", folder->path.string()}, {"bytes", total}, {"limit_bytes", folder->limit}, {"entries", entries}});
  return ExitCode::ok;
}

}  // namespace umbrameter
