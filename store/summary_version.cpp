#include "store/summary_version.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "core/error.h"

namespace umbrameter {
namespace {

constexpr const char* version_key = "schema_version";

}  // namespace

nlohmann::ordered_json summary_head(const std::string& command) {
  return {{version_key, summary_schema_version},
          {"program", {{"name", "umbrameter"}, {"version", UMBRAMETER_VERSION}}},
          {"command", command}};
}

void require_known_schema(const nlohmann::ordered_json& summary, const std::filesystem::path& path) {
  if (!summary.is_object() || !summary.contains(version_key)) return;
  const nlohmann::ordered_json& version = summary[version_key];
  if (version.is_number_integer() && version <= summary_schema_version) return;
  throw Error(
      ExitCode::unreadable_input, path.string(),
      fmt::format("a later version of umbrameter wrote it: schema version {}, this program reads up to {}",
                  version.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace), summary_schema_version),
      "update umbrameter, or rerun the command with this version");
}

}  // namespace umbrameter
