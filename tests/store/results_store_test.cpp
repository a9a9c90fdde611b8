#include "store/results_store.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "tests/store/small_store.h"
#include "tests/support/temporary_folder.h"

namespace umbrameter {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

TEST(ResultsStore, Rows_come_back_in_the_order_of_cells_however_they_were_added) {
  const TemporaryFolder folder;
  ResultsStore store = ResultsStore::open(folder.path(), description());
  EXPECT_FALSE(store.complete());
  EXPECT_EQ(store.count(), 0u);
  add(store, {3, 1});
  EXPECT_TRUE(store.has_group(3));
  EXPECT_FALSE(store.has_group(1)) << "a cell of it, but not its first";
  add(store, {2, 0});
  EXPECT_EQ(all_rows(store), rows);
  store.finish();
  EXPECT_TRUE(store.complete());
  EXPECT_EQ(all_rows(store), rows);
  EXPECT_EQ(all_rows(store, {"mae", "shadow.filter"})[2], (std::vector<Value>{0.125, "box"}));
  EXPECT_THROW(all_rows(store, {"nothing"}), std::out_of_range);
}

TEST(ResultsStore, The_finished_file_stands_alone_under_its_name_and_only_then) {
  const TemporaryFolder folder;
  ResultsStore store = ResultsStore::open(folder.path(), description());
  add(store, {0, 1});
  EXPECT_TRUE(std::filesystem::exists(folder / "results.partial.sqlite"));
  EXPECT_FALSE(std::filesystem::exists(folder / "results.sqlite"));
  add(store, {2, 3});
  store.finish();
  EXPECT_EQ(count_files(folder.path()), 1u) << "no journal and no partial file is left";
  EXPECT_TRUE(std::filesystem::exists(folder / "results.sqlite"));
}

TEST(ResultsStore, The_finished_bytes_do_not_depend_on_order_or_on_restarts) {
  std::vector<std::string> files;
  for (const std::vector<std::vector<std::size_t>>& groups :
       {std::vector<std::vector<std::size_t>>{{0, 1, 2, 3}}, {{3}, {1}, {0}, {2}}, {{2, 3}, {1, 0}}}) {
    const TemporaryFolder folder;
    for (const std::vector<std::size_t>& group : groups) {
      ResultsStore store = ResultsStore::open(folder.path(), description());
      add(store, group);
    }
    ResultsStore::open(folder.path(), description()).finish();
    files.push_back(text_of(folder / "results.sqlite"));
  }
  EXPECT_EQ(files[0].substr(0, 15), "SQLite format 3");
  EXPECT_EQ(files[0], files[1]);
  EXPECT_EQ(files[0], files[2]);
}

TEST(ResultsStore, Every_kind_of_value_comes_back_as_it_was) {
  const TemporaryFolder folder;
  StoreDescription four = description(6);
  ResultsStore store = ResultsStore::open(folder.path(), four);
  const std::string odd = "a \"b\", 'c';\n\xc3\xa4\xe2\x82\xac";
  const std::int64_t largest = std::numeric_limits<std::int64_t>::max();
  const std::vector<std::vector<Value>> values = {
      {0.1, odd, largest, nan, true},
      {-1e-300, "", -largest, infinity, false},
      {5e-324, "x", std::int64_t{0}, -infinity, true},
      {std::nextafter(1.0, 2.0), "x", std::int64_t{1} << 53, 1.7976931348623157e308, false},
      {1.0, "1", std::int64_t{1}, 1.0, true},
      {std::int64_t{2}, "0x1", std::int64_t{1}, std::int64_t{3}, true}};
  store.append(0, [&](const CellSink& keep) {
    for (std::size_t i = 0; i < values.size(); ++i) keep(i, values[i]);
  });
  store.finish();
  const std::vector<std::vector<Value>> back = all_rows(store);
  ASSERT_EQ(back.size(), 6u);
  for (std::size_t i = 0; i < 5; ++i) {
    for (std::size_t c = 0; c < 5; ++c) {
      if (i == 0 && c == 3) continue;
      EXPECT_EQ(back[i][c], values[i][c]) << i << " " << c;
    }
  }
  EXPECT_TRUE(std::isnan(std::get<double>(back[0][3]))) << "stored as NULL";
  EXPECT_EQ(back[5], (std::vector<Value>{2.0, "0x1", std::int64_t{1}, 3.0, true})) << "a whole number in a real column";
}

TEST(ResultsStore, Values_of_another_kind_than_the_columns_are_our_mistake) {
  const TemporaryFolder folder;
  ResultsStore store = ResultsStore::open(folder.path(), description());
  const auto put = [&](const std::vector<Value>& values) {
    store.append(0, [&](const CellSink& keep) { keep(0, values); });
  };
  EXPECT_THROW(put({"many", "box", std::int64_t{7}, 0.5, true}), std::logic_error);
  EXPECT_THROW(put({0.0, "box", 7.5, 0.5, true}), std::logic_error);
  EXPECT_THROW(put({0.0, "box", nan, 0.5, true}), std::logic_error) << "only real columns can lack a number";
  EXPECT_THROW(put({0.0, "box"}), std::logic_error);
  EXPECT_EQ(store.count(), 0u);
  put(rows[0]);
  EXPECT_THROW(put(rows[0]), std::logic_error) << "a group that is there already";
  EXPECT_EQ(store.count(), 1u);
  store.append(1, [&](const CellSink& keep) { keep(0, rows[0]); });
  EXPECT_THROW(store.finish(), std::logic_error) << "one cell in two groups";
  EXPECT_FALSE(std::filesystem::exists(folder / "results.sqlite"));
}

TEST(ResultsStore, A_group_is_there_whole_or_not_at_all) {
  const TemporaryFolder folder;
  ResultsStore store = ResultsStore::open(folder.path(), description());
  add(store, {0});
  EXPECT_THROW(store.append(1,
                            [&](const CellSink& keep) {
                              keep(1, rows[1]);
                              keep(2, rows[2]);
                              throw std::runtime_error("evaluator");
                            }),
               std::runtime_error);
  EXPECT_EQ(store.count(), 1u);
  EXPECT_FALSE(store.has_group(1));
  add(store, {1, 2, 3});
  EXPECT_EQ(all_rows(store), rows);
}

TEST(ResultsStore, What_is_stored_says_what_it_is_about) {
  const TemporaryFolder folder;
  {
    ResultsStore store = ResultsStore::open(folder.path(), description());
    add(store, {0, 1, 2, 3});
    store.finish();
  }
  const ResultsStore store = ResultsStore::load(folder.path());
  const StoreDescription& stored = store.description();
  EXPECT_EQ(stored.experiment, "scene = \"corner\"\n");
  EXPECT_EQ(stored.settings, description().settings);
  EXPECT_EQ(stored.axes, description().axes);
  EXPECT_EQ(stored.cells, 4u);
  ASSERT_EQ(stored.columns.size(), 5u);
  EXPECT_EQ(stored.columns[0].column.name, "shadow.constant-bias");
  EXPECT_EQ(stored.columns[0].column.unit, "m");
  EXPECT_EQ(stored.columns[3].column.meaning, "error");
  EXPECT_EQ(stored.columns[4].kind, ValueKind::truth);
}

TEST(ResultsStore, Another_sweep_is_refused_with_the_first_difference) {
  const auto refuse = [](const StoreDescription& other, const std::vector<std::string>& words, bool finished) {
    const TemporaryFolder folder;
    {
      ResultsStore store = ResultsStore::open(folder.path(), description());
      add(store, {0, 1, 2, 3});
      if (finished) store.finish();
    }
    const std::string path = folder / (finished ? "results.sqlite" : "results.partial.sqlite");
    const std::string before = text_of(path);
    expect_error([&] { ResultsStore::open(folder.path(), other); }, ExitCode::usage, words);
    EXPECT_EQ(text_of(path), before);
  };
  for (const bool finished : {false, true}) {
    StoreDescription other = description();
    other.settings[1].second = "32x18";
    refuse(other, {"view.size", "'64x36' in the folder", "'32x18' in this command", "-o", "--force"}, finished);
    other = description();
    other.axes[0].second = "0:2:2";
    refuse(other, {"shadow.constant-bias", "'0:1:2'", "'0:2:2'"}, finished);
    other = description();
    other.axes.pop_back();
    refuse(other, {"shadow.filter", "only in the folder"}, finished);
    other = description();
    other.settings.emplace_back("truth.spp", "4");
    refuse(other, {"truth.spp", "only in this command"}, finished);
    other = description();
    other.columns[3].column.name = "rmse";
    refuse(other, {"mae", "rmse"}, finished);
    refuse(description(5), {"4 cells", "5"}, finished);
  }
}

TEST(ResultsStore, The_experiments_text_alone_makes_no_other_sweep) {
  const TemporaryFolder folder;
  { add(*std::make_unique<ResultsStore>(ResultsStore::open(folder.path(), description())), {0}); }
  StoreDescription worded = description();
  worded.experiment += "# the same in other words\n";
  EXPECT_EQ(ResultsStore::open(folder.path(), worded).count(), 1u);
}

TEST(ResultsStore, Another_maker_may_resume_and_all_are_remembered) {
  const TemporaryFolder folder;
  const auto open = [&](const std::string& maker) {
    StoreDescription described = description();
    described.maker = maker;
    return ResultsStore::open(folder.path(), described);
  };
  add(*std::make_unique<ResultsStore>(open("program A on llvmpipe")), {0, 1});
  add(*std::make_unique<ResultsStore>(open("program A on llvmpipe")), {2});
  ResultsStore store = open("program B on a GPU");
  EXPECT_EQ(store.count(), 3u);
  add(store, {3});
  store.finish();
  const std::vector<std::string> makers = {"program A on llvmpipe", "program B on a GPU"};
  EXPECT_EQ(store.makers(), makers);
  EXPECT_EQ(open("program C").makers(), makers) << "who only reads measures nothing";
}

TEST(ResultsStore, Anew_replaces_what_is_there_whatever_it_is) {
  const TemporaryFolder folder;
  {
    ResultsStore store = ResultsStore::open(folder.path(), description());
    add(store, {0, 1, 2, 3});
    store.finish();
  }
  EXPECT_EQ(ResultsStore::open(folder.path(), description(5), true).count(), 0u);
  EXPECT_FALSE(std::filesystem::exists(folder / "results.sqlite"));
  put_text(folder / "results.partial.sqlite", "not a database at all, but long enough to be taken for a damaged one");
  EXPECT_EQ(ResultsStore::open(folder.path(), description(), true).count(), 0u);
}

TEST(ResultsStore, A_damaged_file_is_told_and_left_alone) {
  const TemporaryFolder whole;
  {
    ResultsStore store = ResultsStore::open(whole.path(), description(2000));
    store.append(0, [&](const CellSink& keep) {
      for (std::size_t i = 0; i < 2000; ++i) keep(i, rows[i % 4]);
    });
    store.finish();
  }
  const std::string bytes = text_of(whole / "results.sqlite");
  ASSERT_GT(bytes.size(), 40'000u);
  std::string garbled = bytes;
  garbled.replace(20'000, 4096, std::string(4096, '\x5a'));
  const std::string text = "not a database at all, but long enough to be taken for a damaged one: " + bytes;
  for (const std::string& damaged : {text, garbled, bytes.substr(0, bytes.size() / 2), bytes.substr(0, 50)}) {
    for (const char* name : {"results.sqlite", "results.partial.sqlite"}) {
      const TemporaryFolder folder;
      put_text(folder / name, damaged);
      expect_error([&] { ResultsStore::open(folder.path(), description(2000)); }, ExitCode::unreadable_input,
                   {name, "damaged", "--force"});
    }
  }
  // Cells are missing under the name of a finished store.
  const TemporaryFolder folder;
  { add(*std::make_unique<ResultsStore>(ResultsStore::open(folder.path(), description())), {0}); }
  std::filesystem::rename(folder / "results.partial.sqlite", folder / "results.sqlite");
  expect_error([&] { ResultsStore::open(folder.path(), description()); }, ExitCode::unreadable_input, {"missing"});
  put_text(folder / "results.sqlite", "");
  expect_error([&] { ResultsStore::open(folder.path(), description()); }, ExitCode::unreadable_input, {"empty"});
}

TEST(ResultsStore, A_file_of_a_later_version_is_refused) {
  const TemporaryFolder folder;
  {
    ResultsStore store = ResultsStore::open(folder.path(), description());
    add(store, {0, 1, 2, 3});
    store.finish();
  }
  std::string bytes = text_of(folder / "results.sqlite");
  ASSERT_EQ(bytes.substr(60, 4), std::string("\0\0\0\3", 4)) << "PRAGMA user_version: SQLite's file format, 1.3.13";
  bytes[63] = 4;
  put_text(folder / "results.sqlite", bytes);
  expect_error([&] { ResultsStore::open(folder.path(), description()); }, ExitCode::usage,
               {"a later version of umbrameter wrote it: schema version 4, this program's is 3"});
}

TEST(ResultsStore, A_folder_that_cannot_hold_it_is_a_usage_error) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "results.partial.sqlite");
  expect_error([&] { ResultsStore::open(folder.path(), description()); }, ExitCode::usage, {"results.partial.sqlite"});
  expect_error([&] { ResultsStore::open(folder / "none", description()); }, ExitCode::usage, {"none"});
}

TEST(ResultsStore, Two_sweeps_at_once_in_one_folder_are_refused) {
  const TemporaryFolder folder;
  ResultsStore first = ResultsStore::open(folder.path(), description());
  add(first, {0});
  for (const bool anew : {false, true}) {
    expect_error([&] { ResultsStore::open(folder.path(), description(), anew); }, ExitCode::usage, {"another sweep"});
  }
  add(first, {1, 2, 3});
  first.finish();
  EXPECT_EQ(all_rows(first), rows);
}

TEST(ResultsStore, The_least_row_is_found_for_each_combination_the_first_of_equals) {
  const TemporaryFolder folder;
  ResultsStore store = ResultsStore::open(folder.path(), description(6));
  add(store, {0, 1, 2, 3});
  store.append(4, [&](const CellSink& keep) {
    keep(4, row(2, "area", nan));
    keep(5, row(2, "box", nan));
  });
  const Table least = store.least("mae", {}, 1);
  ASSERT_EQ(least.rows.size(), 1u);
  EXPECT_EQ(least.rows[0], rows[2]);
  EXPECT_EQ(least.columns[3].name, "mae");
  const Table by_filter = store.least("mae", {"shadow.filter"}, 10);
  ASSERT_EQ(by_filter.rows.size(), 3u);
  EXPECT_EQ(by_filter.rows[0][1], Value("area")) << "no other than one without a number";
  EXPECT_EQ(by_filter.rows[1], rows[2]);
  EXPECT_EQ(by_filter.rows[2], rows[1]) << "0.25 twice: the first";
  EXPECT_EQ(store.least("mae", {"shadow.filter"}, 2).rows.size(), 2u);
  EXPECT_EQ(store.least("mae", {"shadow.constant-bias", "shadow.filter"}, 10).rows.size(), 6u);
  EXPECT_THROW(store.least("nothing", {}, 1), std::out_of_range);
  EXPECT_THROW(store.least("mae", {"nothing"}, 1), std::out_of_range);
}

TEST(ResultsStore, Some_rows_come_in_the_order_asked_for_without_those_that_are_missing) {
  const TemporaryFolder folder;
  ResultsStore store = ResultsStore::open(folder.path(), description());
  add(store, {0, 1, 3});
  const std::vector<std::size_t> cells = {3, 2, 0};
  const Table table = store.rows(cells, {"mae", "shadow.constant-bias"});
  EXPECT_EQ(table.columns[1].unit, "m");
  EXPECT_EQ(table.rows, (std::vector<std::vector<Value>>{{0.25, 1.0}, {0.5, 0.0}}));
}

}  // namespace
}  // namespace umbrameter
