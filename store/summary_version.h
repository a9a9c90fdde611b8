// The version of the schema of summary.json (docs/summary.schema.json), and what this program can read.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace umbrameter {

/// Raise it when a key is removed, renamed or gets another meaning or unit; a new key leaves it as it is.
inline constexpr int summary_schema_version = 2;

/// The keys that every summary.json begins with: "schema_version", "program" and "command".
nlohmann::ordered_json summary_head(const std::string& command);

/// Throws Error (unreadable_input) if the summary's schema is newer than this program's. A summary without a version is
/// from before version 1 and is read as such.
void require_known_schema(const nlohmann::ordered_json& summary, const std::filesystem::path& path);

}  // namespace umbrameter
