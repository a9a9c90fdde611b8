#include "store/shard_file.h"

#include <fmt/format.h>

#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>

#include "core/content_hash.h"
#include "core/error.h"
#include "reports/files/output.h"
#include "reports/files/value_json.h"
#include "store/run_record.h"

namespace umbrameter {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::string_view head = "umbrameter-shard 1\n";
constexpr std::size_t checksum_length = 32;

[[noreturn]] void refuse(const fs::path& path, const std::string& why) {
  throw Error(ExitCode::partial, path.string(), why, "run the shard again");
}

std::string checksum_of(std::string_view bytes) {
  return ContentHash().add_bytes(std::as_bytes(std::span(bytes))).hex();
}

struct ParsedManifest {
  ShardManifest manifest;
  std::size_t row_bytes = 0;
};

ParsedManifest parse_manifest(const fs::path& path, const std::string& line) {
  const Json json = Json::parse(line, nullptr, false);
  try {
    ShardManifest manifest;
    manifest.plan = json.at("plan").get<std::string>();
    manifest.shard = json.at("shard").get<std::size_t>();
    manifest.program = json.at("program").get<std::string>();
    manifest.measured_by = json.at("measured_by").get<decltype(manifest.measured_by)>();
    manifest.maker = json.at("maker").get<std::string>();
    manifest.host = json.at("host").get<std::string>();
    manifest.started = json.at("started").get<std::string>();
    manifest.seconds = json.at("seconds").get<double>();
    manifest.cells = json.at("cells").get<std::size_t>();
    manifest.notes = json.at("notes").get<std::vector<std::string>>();
    return {std::move(manifest), json.at("row_bytes").get<std::size_t>()};
  } catch (const Json::exception&) {
    refuse(path, "its manifest is damaged");
  }
}

}  // namespace

void append_values(std::string& rows, std::span<const Value> values) {
  for (const Value& value : values) {
    char bytes[8];
    if (const auto* real = std::get_if<double>(&value)) {
      std::memcpy(bytes, real, sizeof bytes);
    } else {
      if (std::holds_alternative<std::string>(value)) throw std::logic_error("a shard holds numbers only");
      const auto* truth = std::get_if<bool>(&value);
      const std::int64_t integer = truth != nullptr ? std::int64_t{*truth} : std::get<std::int64_t>(value);
      std::memcpy(bytes, &integer, sizeof bytes);
    }
    rows.append(bytes, sizeof bytes);
  }
}

Value value_at(const char* bytes, ValueKind kind) {
  if (kind == ValueKind::real) {
    double real = 0.0;
    std::memcpy(&real, bytes, sizeof real);
    return real;
  }
  std::int64_t integer = 0;
  std::memcpy(&integer, bytes, sizeof integer);
  if (kind == ValueKind::truth) return integer != 0;
  return integer;
}

void write_shard(const fs::path& path, const ShardManifest& manifest, std::string_view rows) {
  const Json json = {{"plan", manifest.plan},       {"shard", manifest.shard},
                     {"program", manifest.program}, {"measured_by", manifest.measured_by},
                     {"maker", manifest.maker},     {"host", manifest.host},
                     {"started", manifest.started}, {"seconds", manifest.seconds},
                     {"cells", manifest.cells},     {"notes", manifest.notes},
                     {"row_bytes", rows.size()}};
  std::string text(head);
  text += json_text(json) + "\n";
  text += rows;
  text += checksum_of(text);
  write_text(path, text);
}

ShardFile read_shard(const fs::path& path) {
  std::optional<std::string> text = text_of_file(path);
  if (!text) refuse(path, "it cannot be read");
  const std::size_t line_end = text->find('\n', head.size());
  if (!text->starts_with(head) || line_end == std::string::npos) refuse(path, "it is no result of a shard");
  ParsedManifest parsed = parse_manifest(path, text->substr(head.size(), line_end - head.size()));
  const std::size_t rows_end = line_end + 1 + parsed.row_bytes;
  // Compared so that a damaged number cannot overflow.
  if (text->size() < checksum_length || parsed.row_bytes > text->size() - checksum_length ||
      text->size() < rows_end + checksum_length) {
    refuse(path, fmt::format("it is truncated, to {} bytes", text->size()));
  }
  const std::string_view all(*text);
  if (all.substr(rows_end) != checksum_of(all.substr(0, rows_end))) refuse(path, "it does not match its checksum");
  return {std::move(parsed.manifest), text->substr(line_end + 1, parsed.row_bytes)};
}

ShardManifest read_manifest(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::string first;
  std::string line;
  if (!std::getline(file, first) || first + "\n" != head || !std::getline(file, line)) {
    refuse(path, "it is no result of a shard");
  }
  return parse_manifest(path, line).manifest;
}

}  // namespace umbrameter
