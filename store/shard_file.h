// The result of one shard: one file, renamed when it is whole. A line that names the format, a line of JSON (the
// manifest), the measured numbers of the shard's cells in the order of evaluation, 8 bytes each, and a checksum.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/table.h"
#include "store/results_store.h"

namespace umbrameter {

/// Who measured a shard, when and for which plan.
struct ShardManifest {
  std::string plan{};  ///< ShardPlan::id
  std::size_t shard = 0;
  std::string program{};                                           ///< version
  std::vector<std::pair<std::string, std::string>> measured_by{};  ///< kind of device, hash of the sources
  std::string maker{};                                             ///< program, processor, Embree and OpenGL driver
  std::string host{};
  std::string started{};  ///< UTC, "2025-01-31T12:00:00Z"
  double seconds = 0.0;   ///< of measuring
  std::size_t cells = 0;
  std::vector<std::string> notes{};  ///< assumptions made while measuring
};

struct ShardFile {
  ShardManifest manifest;
  std::string rows;
};

/// Appends measured values. Throws std::logic_error for a text.
void append_values(std::string& rows, std::span<const Value> values);
/// One value of 8 bytes.
Value value_at(const char* bytes, ValueKind kind);

/// Throws Error (partial) if it cannot be written.
void write_shard(const std::filesystem::path& path, const ShardManifest& manifest, std::string_view rows);

/// Throws Error (partial) if the file is missing, cut short or does not match its checksum.
ShardFile read_shard(const std::filesystem::path& path);

/// The manifest alone; the rows are not checked. Throws as read_shard().
ShardManifest read_manifest(const std::filesystem::path& path);

}  // namespace umbrameter
