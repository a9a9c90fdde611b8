#include "store/run_folder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <exception>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <system_error>
#include <utility>

#include "core/error.h"
#include "reports/files/output.h"
#include "store/results_store.h"
#include "store/summary_version.h"

namespace umbrameter {
namespace {

namespace fs = std::filesystem;

constexpr const char* figures_name = "figures";

bool is_link(const fs::path& path) {
  std::error_code error;
  return fs::is_symlink(fs::symlink_status(path, error));
}

bool contains(const std::vector<std::string>& files, const std::string& file) {
  return std::ranges::find(files, file) != files.end();
}

bool any_there(const fs::path& folder, const std::vector<std::string>& files) {
  return std::ranges::any_of(files, [&](const std::string& file) { return is_there(folder / file); });
}

// The folders on the way to this one, and itself, that would have to be made; outermost first.
std::vector<fs::path> missing_folders(const fs::path& folder) {
  std::vector<fs::path> missing;
  std::error_code error;
  for (fs::path path = fs::absolute(folder, error); path.has_relative_path() && !is_there(path);
       path = path.parent_path()) {
    const fs::path name = path.filename();
    if (!name.empty() && name != "." && name != "..") missing.push_back(path);
  }
  std::ranges::reverse(missing);
  return missing;
}

// Whether the open file is what the path leads to.
bool is_same_folder(int file, const fs::path& path) {
  struct stat opened {};
  struct stat named {};
  return fstat(file, &opened) == 0 && stat(path.c_str(), &named) == 0 && opened.st_dev == named.st_dev &&
         opened.st_ino == named.st_ino;
}

}  // namespace

RunFolder::Lock::~Lock() {
  if (file >= 0) close(file);
}

RunFolder::MadeFolders::~MadeFolders() {
  std::error_code ignored;
  for (auto path = paths.rbegin(); path != paths.rend(); ++path) {
    if (fs::is_directory(*path, ignored) && fs::is_empty(*path, ignored)) fs::remove(*path, ignored);
  }
}

RunFolder::RunFolder(fs::path folder, RunPlan plan, bool force)
    : folder_(std::move(folder)), plan_(std::move(plan)), force_(force), record_{plan_.command, false, {}} {
  if (!folder_.empty()) made_.paths = missing_folders(folder_);
  prepare_output_folder(folder_);
  lock();
  remove_abandoned(folder_);
  if (!is_link(folder_ / figures_name)) remove_abandoned(folder_ / figures_name);
  had_record_ = is_there(folder_ / run_record_name);
  earlier_ = read_run_record(folder_);
  if (earlier_ && !any_there(folder_, earlier_->files)) earlier_.reset();
  if (!force_) require_own();
  require_free(plan_.files);
  // Through a link the run would write into a folder that is not its own.
  if (is_link(folder_ / figures_name)) require_free({figures_name});
}

RunFolder::~RunFolder() {
  if (!is_finished_) take_back();
}

void RunFolder::lock() {
  // A run that fails may remove the folder after it was opened here.
  for (int attempts = 0; attempts < 10; ++attempts) {
    const int file = open(folder_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (file < 0) {
      prepare_output_folder(folder_);
      continue;
    }
    const bool is_busy = flock(file, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
    if (!is_busy && is_same_folder(file, folder_)) {
      lock_.file = file;
      return;
    }
    close(file);
    if (!is_busy) prepare_output_folder(folder_);
    if (is_busy) {
      throw Error(ExitCode::usage, "cannot use " + folder_.string() + " as output folder",
                  "another run is writing to it", "wait until it ends or choose another folder with -o");
    }
  }
}

// Throws unless this run may take the folder from the earlier one.
void RunFolder::require_own() const {
  if (!earlier_) return;
  if (const std::optional<std::string> text = text_of_file(folder_ / "summary.json")) {
    require_known_schema(nlohmann::ordered_json::parse(*text, nullptr, false), folder_ / "summary.json");
  }
  const bool is_same_command = earlier_->command == plan_.command;
  if (is_same_command && plan_.resumes_store && any_there(folder_, ResultsStore::file_names())) return;
  if (is_same_command && !earlier_->complete && text_of_file(folder_ / "experiment.toml") == plan_.experiment) return;
  throw Error(ExitCode::usage, "cannot use " + folder_.string() + " as output folder",
              fmt::format("it holds {} of '{}'", earlier_->complete ? "the results" : "the unfinished results",
                          earlier_->command.empty() ? "umbrameter" : "umbrameter " + earlier_->command),
              "choose another folder with -o, or replace them with --force");
}

void RunFolder::require_free(const std::vector<std::string>& files) const {
  if (force_) return;
  for (const std::string& file : files) {
    if (contains(record_.files, file) || (earlier_ && contains(earlier_->files, file))) continue;
    if (!is_there(folder_ / file)) continue;
    throw Error(ExitCode::usage, (folder_ / file).string(), "the file exists and no recorded run wrote it",
                "move it away, choose another folder with -o, or overwrite it with --force");
  }
}

void RunFolder::write_record() const {
  RunRecord record = record_;
  if (earlier_) {
    if (!is_begun_) {
      record.command = earlier_->command;
      record.complete = earlier_->complete;
    }
    add_files(record.files, earlier_->files);
  }
  write_run_record(folder_, record);
}

void RunFolder::announce(const std::vector<std::string>& files) {
  std::vector<std::string> named;
  std::copy_if(files.begin(), files.end(), std::back_inserter(named), is_recordable);
  for (const std::string& file : named) {
    if (!is_begun_ && !is_there(folder_ / file)) new_files_.push_back(file);
  }
  add_files(record_.files, named);
  write_record();
}

void RunFolder::begin() {
  if (std::exchange(is_begun_, true)) return;
  std::vector<std::string> obsolete;
  if (earlier_) {
    std::copy_if(earlier_->files.begin(), earlier_->files.end(), std::back_inserter(obsolete),
                 [&](const std::string& file) { return !contains(record_.files, file); });
  }
  // With --force the link gives way, and what it leads to stays.
  if (is_link(folder_ / figures_name)) remove_files(folder_, {figures_name});
  add_files(record_.files, plan_.files);
  write_record();  // of both runs, until the earlier one's files are gone
  if (!earlier_) return;
  remove_files(folder_, obsolete);
  earlier_.reset();
  write_record();
}

void RunFolder::finish(bool complete) {
  std::erase_if(record_.files, [&](const std::string& file) { return !is_there(folder_ / file); });
  record_.complete = complete;
  write_record();
  is_finished_ = true;
}

void RunFolder::take_back() noexcept {
  try {
    if (!is_begun_) {
      remove_files(folder_, new_files_);
      if (!record_.files.empty() && earlier_ && had_record_) return write_run_record(folder_, *earlier_);
    }
    const bool is_needed = is_begun_ ? any_there(folder_, record_.files) : earlier_ && had_record_;
    std::error_code ignored;
    if (!is_needed) fs::remove(folder_ / run_record_name, ignored);
  } catch (const std::exception&) {
    // The error that ends the run is the one to report; the record still lists what is there.
  }
}

}  // namespace umbrameter
