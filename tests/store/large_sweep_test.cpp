// How much memory and time many cells take.
#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <sstream>

#include "reports/files/data.h"
#include "tests/store/fake_sweep.h"
#include "tests/support/temporary_folder.h"

namespace umbrameter {
namespace {

// Most memory that this process has held since the last reset, MiB.
double peak_memory() {
  std::istringstream status(text_of("/proc/self/status"));
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with("VmHWM:")) return std::stod(line.substr(6)) / 1024.0;
  }
  return 0.0;
}
void reset_peak_memory() { std::ofstream("/proc/self/clear_refs") << "5"; }

TEST(LargeSweep, A_million_cells_take_no_more_memory_than_one_group) {
  using Clock = std::chrono::steady_clock;
  const auto seconds = [](Clock::time_point since) {
    return std::chrono::duration<double>(Clock::now() - since).count();
  };
  const TemporaryFolder folder;
  // The axis that runs fastest is an outer one: the rows of a group lie far apart.
  FakeSweep sweep({"shadow.constant-bias=0:1:2500", "shadow.slope-bias=0:3:4", "shadow.resolution=1:100:100"});
  reset_peak_memory();
  const double before = peak_memory();
  Clock::time_point start = Clock::now();
  sweep.run(folder.path());
  RecordProperty("rows_a_second_stored", std::to_string(1e6 / seconds(start)));
  const ResultsStore store = ResultsStore::load(folder.path());
  std::vector<Column> columns;
  for (const StoredColumn& stored : store.description().columns) columns.push_back(stored.column);
  start = Clock::now();
  write_csv(folder / "sweep.csv", columns, [&](const StoredRowSink& sink) { store.read({}, sink); });
  RecordProperty("rows_a_second_written_as_csv", std::to_string(1e6 / seconds(start)));
  start = Clock::now();
  EXPECT_EQ(store.least("mae", {"shadow.resolution"}, 1000).rows.size(), 100u);
  EXPECT_EQ(store.least("mae", {}, 1).rows.front()[3], Value(std::int64_t{0}));
  RecordProperty("seconds_for_the_least_rows", std::to_string(seconds(start)));
  EXPECT_EQ(store.count(), 1'000'000u);
  // 48 million bytes of values alone, were they held.
  EXPECT_LT(peak_memory() - before, 64.0) << "MiB";
  RecordProperty("peak_memory_mib", std::to_string(peak_memory() - before));
}

}  // namespace
}  // namespace umbrameter
