#include "store/run_record.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string_view>
#include <system_error>

#include "core/error.h"
#include "reports/files/output.h"
#include "reports/files/value_json.h"
#include "store/results_store.h"

namespace umbrameter {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr int format = 1;
constexpr const char* format_key = "umbrameter_run";

// The texts of a list that name files; everything else in it is left out.
std::vector<std::string> recordable_files(const Json& list) {
  std::vector<std::string> files;
  if (!list.is_array()) return files;
  for (const Json& item : list) {
    if (item.is_string() && is_recordable(item.get<std::string>())) files.push_back(item.get<std::string>());
  }
  return files;
}

// The figures that a page links to: href="figures/NAME".
std::vector<std::string> linked_figures(const std::string& page) {
  constexpr std::string_view link = "href=\"";
  std::vector<std::string> figures;
  for (std::size_t at = page.find(link); at != std::string::npos; at = page.find(link, at + 1)) {
    const std::size_t begin = at + link.size();
    const std::string target = page.substr(begin, page.find('"', begin) - begin);
    if (target.starts_with("figures/") && is_recordable(target)) figures.push_back(target);
  }
  return figures;
}

// Versions without records wrote summary.json last but for the page, and listed in it all files but the figures.
std::optional<RunRecord> record_of_summary(const fs::path& folder) {
  const std::optional<std::string> text = text_of_file(folder / "summary.json");
  if (!text) return {};
  const Json summary = Json::parse(*text, nullptr, false);
  if (!summary.is_object() || !summary.contains("program") || !summary["program"].is_object()) return {};
  if (summary["program"].value("name", Json()) != "umbrameter" || !summary.contains("files")) return {};
  RunRecord record;
  record.command = summary.value("command", Json()).is_string() ? summary["command"].get<std::string>() : "";
  record.complete = true;
  record.files = recordable_files(summary["files"]);
  const bool has_page = std::ranges::find(record.files, "index.html") != record.files.end();
  if (has_page) add_files(record.files, linked_figures(text_of_file(folder / "index.html").value_or("")));
  return record;
}

// Of a sweep that was interrupted before it had a summary.
std::optional<RunRecord> record_of_store(const fs::path& folder) {
  const std::vector<std::string> store = ResultsStore::file_names();
  if (std::ranges::none_of(store, [&](const std::string& name) { return is_there(folder / name); })) {
    return {};
  }
  RunRecord record{"sweep", false, {"experiment.toml", "images.exr", "sweep.csv"}};
  add_files(record.files, store);
  return record;
}

}  // namespace

bool is_recordable(const std::string& file) {
  constexpr std::string_view figures = "figures/";
  const std::string name = file.starts_with(figures) ? file.substr(figures.size()) : file;
  return !name.empty() && name.front() != '.' && name.find('/') == std::string::npos &&
         name.find('\0') == std::string::npos;
}

std::optional<RunRecord> read_run_record(const fs::path& folder) {
  const fs::path path = folder / run_record_name;
  if (!is_there(path)) {
    std::optional<RunRecord> record = record_of_summary(folder);
    return record ? record : record_of_store(folder);
  }
  const auto fail = [&](const char* why) {
    throw Error(ExitCode::unreadable_input, path.string(), why,
                "choose another folder with -o, or remove this file and what the run wrote");
  };
  const std::optional<std::string> text = text_of_file(path);
  if (!text) fail("this record of an earlier run cannot be read");
  const Json json = Json::parse(*text, nullptr, false);
  if (!json.is_object() || !json.value(format_key, Json()).is_number_integer()) {
    fail("this record of an earlier run is damaged");
  }
  if (json[format_key] > format) fail("a later version of umbrameter wrote this record");
  RunRecord record;
  record.command = json.value("command", Json()).is_string() ? json["command"].get<std::string>() : "";
  record.complete = json.value("complete", Json()) == true;
  record.files = recordable_files(json.value("files", Json()));
  return record;
}

void write_run_record(const fs::path& folder, const RunRecord& record) {
  const Json json = {
      {format_key, format}, {"command", record.command}, {"complete", record.complete}, {"files", record.files}};
  write_text(folder / run_record_name, json_text(json, 2) + "\n");
}

void add_files(std::vector<std::string>& list, const std::vector<std::string>& files) {
  for (const std::string& file : files) {
    if (std::ranges::find(list, file) == list.end()) list.push_back(file);
  }
}

void remove_files(const fs::path& folder, const std::vector<std::string>& files) {
  bool any_figure = false;
  for (const std::string& file : files) {
    if (!is_recordable(file)) continue;
    std::error_code error;
    fs::remove(folder / file, error);
    if (error && error != std::errc::not_a_directory) {
      throw Error(ExitCode::usage, "cannot remove " + (folder / file).string(), error.message(),
                  "choose another folder with -o");
    }
    any_figure = any_figure || file.starts_with("figures/");
  }
  std::error_code ignored;
  if (any_figure) fs::remove(folder / "figures", ignored);  // fails, as it should, when something is left in it
}

}  // namespace umbrameter
