#include "store/stored_sweep.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "reports/files/data.h"
#include "tests/store/fake_sweep.h"
#include "tests/support/temporary_folder.h"

namespace umbrameter {
namespace {

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
  EXPECT_THROW(run_sweep(sweep.plan, store, [&](const CellGroup&, const RowSink& keep) { keep(0, row); }),
               std::logic_error);
  EXPECT_THROW(run_sweep(sweep.plan, store,
                         [&](const CellGroup& group, const RowSink& keep) {
                           for (std::size_t i = 0; i < group.size(); ++i) keep(0, row);
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

}  // namespace
}  // namespace umbrameter
