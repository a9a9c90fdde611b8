#include "reports/stored_sweep.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "reports/data.h"
#include "tests/support/temporary_folder.h"

namespace umbrameter {
namespace {

struct Sample {
  int resolution = 256;
  double constant_bias = 0.02;
  double slope_bias = 0.0;
  std::string filter = "nearest";
};

Parameters describe(Sample& s) {
  return Description("shadow")
      .field("resolution", s.resolution, {"texels", "resolution"})
      .field("constant-bias", s.constant_bias, {"m", "constant bias"})
      .field("slope-bias", s.slope_bias, {"texels", "slope-scaled bias"})
      .field("filter", s.filter, {"", "filter"})
      .take();
}

const std::vector<Column> measured = {{"pixels", "px", "counted"}, {"mae", "1", "error"}};

// A sweep whose evaluator computes sums, and can be told to fail.
struct FakeSweep {
  explicit FakeSweep(const std::vector<std::string>& assignments) {
    const Parameters parameters = describe(sample);
    std::vector<SweepAxis> axes;
    for (const std::string& assignment : assignments) axes.push_back(parse_axis(parameters, assignment));
    plan = plan_sweep(parameters, axes);
    const std::vector<Value> row = {std::int64_t{0}, 0.0};
    description.columns = stored_columns(parameters, plan, measured, row);
    for (const SweepAxis& axis : axes) description.axes.emplace_back(axis.key, axis.text);
    description.cells = plan.cells;
  }

  void evaluate(const CellGroup& group, const RowSink& keep) {
    ++groups;
    for (std::size_t s = 0; s < group.slope_bias.values.size(); ++s) {
      for (std::size_t c = 0; c < group.constant_bias.values.size(); ++c) {
        if (rows == fail_after_rows) throw std::runtime_error("evaluator");
        ++rows;
        keep(c, s,
             std::vector<Value>{static_cast<std::int64_t>(group.cell(c, s)),
                                group.constant_bias.values[c] + 10 * group.slope_bias.values[s]});
      }
    }
  }

  void run(const std::filesystem::path& folder, const Progress& progress = {}) {
    ResultsStore store = ResultsStore::open(folder, description);
    run_sweep(
        plan, store, [this](const CellGroup& group, const RowSink& keep) { evaluate(group, keep); }, progress);
  }

  Sample sample;
  SweepPlan plan;
  StoreDescription description;
  std::size_t groups = 0;
  std::size_t rows = 0;
  std::size_t fail_after_rows = std::numeric_limits<std::size_t>::max();
};

const std::vector<std::string> four_groups = {"shadow.constant-bias=0:1:3", "shadow.resolution=256,512",
                                              "shadow.slope-bias=0,1", "shadow.filter=box,nearest"};

TEST(StoredSweep, Rows_stand_in_grid_order_with_axis_and_measured_columns) {
  const TemporaryFolder folder;
  FakeSweep sweep(four_groups);
  std::vector<double> shares;
  sweep.run(folder.path(), [&](double share) { shares.push_back(share); });
  EXPECT_EQ(sweep.groups, 4u);
  EXPECT_EQ(shares, (std::vector<double>{0.0, 0.25, 0.5, 0.75, 1.0}));
  const ResultsStore store = ResultsStore::load(folder.path());
  std::vector<std::vector<Value>> rows;
  store.read({}, [&](std::span<const Value> row) { rows.emplace_back(row.begin(), row.end()); });
  ASSERT_EQ(rows.size(), 24u);
  std::size_t cell = 0;
  for (const double bias : {0.0, 0.5, 1.0}) {
    for (const std::int64_t resolution : {256, 512}) {
      for (const double slope : {0.0, 1.0}) {
        for (const char* filter : {"box", "nearest"}) {
          EXPECT_EQ(rows[cell], (std::vector<Value>{bias, resolution, slope, filter, static_cast<std::int64_t>(cell),
                                                    bias + 10 * slope}));
          ++cell;
        }
      }
    }
  }
}

TEST(StoredSweep, A_sweep_stopped_at_any_row_goes_on_to_the_same_file) {
  const TemporaryFolder undisturbed;
  FakeSweep(four_groups).run(undisturbed.path());
  const std::string expected = text_of(undisturbed / "results.sqlite");
  for (std::size_t stop = 0; stop < 24; ++stop) {
    const TemporaryFolder folder;
    FakeSweep first(four_groups);
    first.fail_after_rows = stop;
    EXPECT_THROW(first.run(folder.path()), std::runtime_error);
    EXPECT_FALSE(std::filesystem::exists(folder / "results.sqlite"));
    const std::size_t whole = stop / 6;
    EXPECT_EQ(ResultsStore::open(folder.path(), first.description).count(), 6 * whole);
    FakeSweep second(four_groups);
    std::vector<double> shares;
    second.run(folder.path(), [&](double share) { shares.push_back(share); });
    EXPECT_EQ(second.groups, 4 - whole) << "only what is missing is measured";
    EXPECT_EQ(shares.front(), static_cast<double>(whole) / 4);
    EXPECT_EQ(text_of(folder / "results.sqlite"), expected) << "stopped after " << stop << " rows";
    FakeSweep third(four_groups);
    third.run(folder.path());
    EXPECT_EQ(third.groups, 0u) << "all is there";
  }
}

TEST(StoredSweep, A_sweep_stopped_again_and_again_ends_in_the_same_file) {
  const TemporaryFolder undisturbed;
  FakeSweep(four_groups).run(undisturbed.path());
  const TemporaryFolder folder;
  for (const int stop : {3, 7, 5, 6, 11}) {
    FakeSweep sweep(four_groups);
    sweep.fail_after_rows = static_cast<std::size_t>(stop);
    EXPECT_THROW(sweep.run(folder.path()), std::runtime_error);
  }
  // One group from the second run, one each from the fourth and fifth.
  EXPECT_EQ(ResultsStore::open(folder.path(), FakeSweep(four_groups).description).count(), 3u * 6);
  FakeSweep(four_groups).run(folder.path());
  EXPECT_EQ(text_of(folder / "results.sqlite"), text_of(undisturbed / "results.sqlite"));
}

TEST(StoredSweep, An_evaluator_that_leaves_cells_out_is_found_out) {
  const TemporaryFolder folder;
  FakeSweep sweep(four_groups);
  ResultsStore store = ResultsStore::open(folder.path(), sweep.description);
  const std::vector<Value> row = {std::int64_t{1}, 1.0};
  EXPECT_THROW(run_sweep(sweep.plan, store, [&](const CellGroup&, const RowSink& keep) { keep(0, 0, row); }),
               std::logic_error);
  EXPECT_THROW(run_sweep(sweep.plan, store,
                         [&](const CellGroup& group, const RowSink& keep) {
                           for (std::size_t i = 0; i < group.size(); ++i) keep(0, 0, row);
                         }),
               std::logic_error);
  EXPECT_EQ(store.count(), 0u);
}

TEST(StoredSweep, The_csv_file_is_a_view_of_the_store) {
  const TemporaryFolder folder;
  FakeSweep sweep({"shadow.filter=\"a\",b", "shadow.constant-bias=0.1,1e-9,1e30"});
  sweep.run(folder.path());
  const ResultsStore store = ResultsStore::load(folder.path());
  Table table;
  for (const StoredColumn& stored : store.description().columns) table.columns.push_back(stored.column);
  store.read({}, [&](std::span<const Value> row) { table.rows.emplace_back(row.begin(), row.end()); });
  write_csv(folder / "sweep.csv", table.columns, [&](const StoredRowSink& sink) { store.read({}, sink); });
  EXPECT_EQ(text_of(folder / "sweep.csv"), to_csv(table));
  EXPECT_EQ(text_of(folder / "sweep.csv"),
            "shadow.filter,shadow.constant-bias,pixels,mae\r\n"
            "\"\"\"a\"\"\",0.1,0,0.1\r\n\"\"\"a\"\"\",1e-09,1,1e-09\r\n\"\"\"a\"\"\",1e+30,2,1e+30\r\n"
            "b,0.1,3,0.1\r\nb,1e-09,4,1e-09\r\nb,1e+30,5,1e+30\r\n");
}

// Most memory that this process has held since the last reset, MiB.
double peak_memory() {
  std::istringstream status(text_of("/proc/self/status"));
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with("VmHWM:")) return std::stod(line.substr(6)) / 1024.0;
  }
  return 0.0;
}
void reset_peak_memory() { std::ofstream("/proc/self/clear_refs") << "5"; }

TEST(StoredSweep, A_million_cells_take_no_more_memory_than_one_group) {
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
  EXPECT_LT(peak_memory() - before, 40.0) << "MiB";
  RecordProperty("peak_memory_mib", std::to_string(peak_memory() - before));
}

}  // namespace
}  // namespace umbrameter
