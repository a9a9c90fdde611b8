#include "store/merge_shards.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <limits>
#include <optional>
#include <set>
#include <utility>

#include "core/error.h"
#include "core/interrupt.h"
#include "reports/files/output.h"

namespace umbrameter {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t value_bytes = 8;
constexpr std::size_t cells_at_once = 4096;

void add_new(std::vector<std::string>& list, const std::string& text) {
  if (std::ranges::find(list, text) == list.end()) list.push_back(text);
}

std::string value_of(const std::vector<std::pair<std::string, std::string>>& pairs, const std::string& name) {
  for (const auto& [key, value] : pairs) {
    if (key == name) return value;
  }
  return {};
}

// Results under names that no shard has: copies that someone renamed.
void report_strangers(const fs::path& folder, const ShardPlan& plan, std::vector<std::string>& problems) {
  std::set<std::string> names;
  std::error_code end;
  for (fs::directory_iterator i(folder / "shards", end); !end && i != fs::directory_iterator(); i.increment(end)) {
    const std::string name = i->path().filename().string();
    if (i->path().extension() == ".shard" && !name.starts_with('.')) names.insert(name);
  }
  for (std::size_t shard = 0; shard < plan.shards.size(); ++shard) names.erase(fmt::format("{}.shard", shard));
  for (const std::string& name : names) {
    problems.push_back((folder / "shards" / name).string() + ": the plan has no shard of this name; ignored");
  }
}

}  // namespace

ScratchRows::ScratchRows(const fs::path& folder, const SweepPlan& plan, std::vector<ValueKind> kinds)
    : plan_(&plan),
      path_(folder / fmt::format(".merge.{}.tmp", getpid())),
      kinds_(std::move(kinds)),
      is_there_(plan.cells) {
  file_ = open(path_.c_str(), O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
  if (file_ < 0) throw_write_error(path_, errno);
  unlink(path_.c_str());
}

ScratchRows::~ScratchRows() {
  if (file_ >= 0) close(file_);
}

bool ScratchRows::add(const PlannedShard& shard, std::string_view rows) {
  const std::size_t row_bytes = kinds_.size() * value_bytes;
  std::vector<std::pair<std::size_t, std::size_t>> cells;  // and the place of their rows
  for_each_joined_group(*plan_, shard.first_group, shard.groups, [&](const CellGroup& group) {
    for (std::size_t place = 0; place < group.size(); ++place) cells.emplace_back(group.cell(place), cells.size());
  });
  if (rows.size() != cells.size() * row_bytes) return false;
  // The cells of a group may lie apart, those of neighbouring groups side by side: few writes then do.
  std::ranges::sort(cells);
  std::string run;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    run.append(rows.substr(cells[i].second * row_bytes, row_bytes));
    if (i + 1 < cells.size() && cells[i + 1].first == cells[i].first + 1) continue;
    const std::size_t end = (cells[i].first + 1) * row_bytes;
    for (std::size_t written = 0; written < run.size();) {
      const std::size_t left = run.size() - written;
      const ssize_t step = pwrite(file_, run.data() + written, left, static_cast<off_t>(end - left));
      if (step < 0 && errno != EINTR) throw_write_error(path_, errno);
      written += static_cast<std::size_t>(std::max<ssize_t>(step, 0));
    }
    run.clear();
  }
  for (const auto& [cell, row] : cells) is_there_[cell] = true;
  count_ += cells.size();
  return true;
}

void ScratchRows::read(const CellSink& sink, bool missing) const {
  const std::size_t row_bytes = kinds_.size() * value_bytes;
  const std::vector<SweepAxis>& axes = plan_->axes;
  std::vector<Value> values(axes.size() + kinds_.size());
  std::vector<std::size_t> index(axes.size(), std::size_t(-1));
  std::string block;
  for (std::size_t first = 0; first < plan_->cells; first += cells_at_once) {
    const std::size_t count = std::min(cells_at_once, plan_->cells - first);
    block.assign(count * row_bytes, '\0');
    // Behind the last row the file ends: those cells are not there.
    for (std::size_t got = 0; got < block.size();) {
      const ssize_t step =
          pread(file_, block.data() + got, block.size() - got, static_cast<off_t>(first * row_bytes + got));
      if (step < 0 && errno != EINTR) throw_write_error(path_, errno);
      if (step == 0) break;
      got += static_cast<std::size_t>(std::max<ssize_t>(step, 0));
    }
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t cell = first + i;
      if (!is_there_[cell] && !missing) continue;
      for (std::size_t a = 0; a < axes.size(); ++a) {
        const std::size_t now = cell / plan_->strides[a] % axes[a].values.size();
        if (now == index[a]) continue;
        index[a] = now;
        values[a] = axes[a].values[now];
      }
      for (std::size_t c = 0; c < kinds_.size(); ++c) {
        Value& value = values[axes.size() + c];
        value = value_at(block.data() + i * row_bytes + c * value_bytes, kinds_[c]);
        if (!is_there_[cell] && kinds_[c] == ValueKind::real) value = std::numeric_limits<double>::quiet_NaN();
      }
      sink(cell, values);
    }
  }
}

std::string objection_to(const ShardManifest& manifest, const ShardPlan& plan, std::size_t shard) {
  if (manifest.program != plan.program) {
    return fmt::format("umbrameter {} measured it, the plan is of {}", manifest.program, plan.program);
  }
  for (const auto& [name, value] : manifest.measured_by) {
    const std::string planned = value_of(plan.identity, name);
    if (value != planned) return fmt::format("its {} is '{}', that of the plan is '{}'", name, value, planned);
  }
  if (manifest.shard >= plan.shards.size() || manifest.plan != id_of(plan, manifest.shard)) {
    return "it belongs to another plan";
  }
  if (manifest.shard != shard) return fmt::format("it is a duplicate of shard {}", manifest.shard);
  return {};
}

CollectedShards collect_shards(const fs::path& folder, const ShardPlan& plan, ScratchRows& rows,
                               const Progress& progress) {
  CollectedShards collected;
  for (std::size_t shard = 0; shard < plan.shards.size(); ++shard) {
    throw_if_interrupted();
    if (progress) progress(static_cast<double>(shard) / static_cast<double>(plan.shards.size()));
    const fs::path path = shard_file(folder, shard);
    std::string problem;
    if (!is_there(path)) {
      collected.missing.push_back(shard);
      continue;
    }
    std::optional<ShardFile> file;
    try {
      file = read_shard(path);
    } catch (const Error& error) {
      problem = error.what();
    }
    if (file) {
      problem = objection_to(file->manifest, plan, shard);
      if (problem.empty() && !rows.add(plan.shards[shard], file->rows)) problem = "it has another number of cells";
      if (!problem.empty()) problem = path.string() + ": " + problem + "; run the shard again";
    }
    if (problem.empty()) {
      add_new(collected.makers, file->manifest.maker);
      for (const std::string& text : file->manifest.notes) add_new(collected.notes, text);
      collected.seconds += file->manifest.seconds;
    }
    if (problem.empty()) continue;
    collected.missing.push_back(shard);
    collected.problems.push_back(problem);
  }
  report_strangers(folder, plan, collected.problems);
  return collected;
}

}  // namespace umbrameter
