// Sweeps that are stopped after their last cell, while they are drawn.
#include <gtest/gtest.h>

#include <csignal>
#include <span>

#include "store/results_store.h"
#include "tests/app/gl_run.h"

namespace umbrameter {
namespace {

namespace fs = std::filesystem;

struct SweepDrawing : GlRun {};

constexpr std::size_t groups = 20;
constexpr std::size_t cells_of_group = 4;

std::vector<std::string> sweep(const fs::path& output, const std::string& flag = "--quiet") {
  return {"sweep",
          "corner",
          "-o",
          output,
          "--size",
          "32x18",
          "--light",
          "0",
          "--shadow.fit",
          "bounds",
          "--vary",
          "shadow.constant-bias=0:0.1:4",
          "--vary",
          "shadow.fit-size=4:8:20",
          flag};
}

// What a sweep that is stopped after its last group leaves: a growing store with every cell, and the experiment.
void leave_every_cell_unfinished(const fs::path& finished, const fs::path& folder) {
  fs::create_directory(folder);
  fs::copy(finished / "experiment.toml", folder);
  const ResultsStore from = ResultsStore::load(finished);
  std::vector<std::vector<Value>> rows;
  from.read({}, [&](std::span<const Value> row) { rows.emplace_back(row.begin(), row.end()); });
  ASSERT_EQ(rows.size(), groups * cells_of_group);
  ResultsStore growing = ResultsStore::open(folder, from.description());
  for (std::size_t first = 0; first < rows.size(); first += cells_of_group) {
    growing.append(first, [&](const CellSink& keep) {
      for (std::size_t cell = first; cell < first + cells_of_group; ++cell) keep(cell, rows[cell]);
    });
  }
}

TEST_F(SweepDrawing, Ctrl_c_keeps_the_cells_and_says_so) {
  ASSERT_EQ(run_program(sweep(folder_ / "finished")).exit_code, 0);
  const fs::path folder = folder_ / "out";
  leave_every_cell_unfinished(folder_ / "finished", folder);
  ProgramOptions options;
  options.signal = SIGINT;
  options.signal_counts_from = [&] { return fs::exists(folder / "results.sqlite"); };
  const ProgramResult stopped = run_program(sweep(folder), options);
  EXPECT_EQ(stopped.exit_code, 130);
  EXPECT_NE(stopped.err.find("80 of 80 cells are stored in"), std::string::npos) << stopped.err;
  EXPECT_NE(stopped.err.find("rerun the command to resume"), std::string::npos) << stopped.err;
  EXPECT_TRUE(fs::exists(folder / "results.sqlite"));
  const ProgramResult again = run_program(sweep(folder, "--no-figures"));
  EXPECT_EQ(again.exit_code, 0) << again.err;
  EXPECT_NE(again.err.find("all 80 cells are done"), std::string::npos) << again.err;
  EXPECT_EQ(text_of(folder / "sweep.csv"), text_of(folder_ / "finished" / "sweep.csv"));
}

}  // namespace
}  // namespace umbrameter
