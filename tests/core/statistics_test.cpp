#include "core/statistics.h"

#include <gtest/gtest.h>

#include <cmath>

namespace umbrameter {
namespace {

struct Sampled {
  std::uint64_t pixels = 3;
  double mae = 0.5;
  Estimate rmse{0.25, 0.125, 0.375};
};

Statistics describe(Sampled& s) {
  return StatisticsDescription()
      .field("pixels", s.pixels, "px", "counted")
      .field("mae", s.mae, "1", "mean absolute error", {"Error", "error [%]", true})
      .field("rmse", s.rmse, "1", "root mean square error")
      .take();
}

TEST(Statistics, An_estimate_makes_three_columns) {
  const std::vector<Column> columns = columns_of(Sampled{});
  std::vector<std::string> names;
  for (const Column& column : columns) {
    names.push_back(column.name);
    EXPECT_FALSE(column.unit.empty()) << column.name;
    EXPECT_FALSE(column.meaning.empty()) << column.name;
  }
  EXPECT_EQ(names, (std::vector<std::string>{"pixels", "mae", "rmse", "rmse_lo", "rmse_hi"}));
}

TEST(Statistics, A_row_read_by_name_gives_the_object_back) {
  const std::vector<Value> row = row_of(Sampled{7, 0.1, {0.2, 0.3, 0.4}});
  // In another order, with a column that the object does not know and without one that it does.
  const std::vector<std::string> columns = {"rmse_hi", "unknown", "rmse", "pixels", "rmse_lo"};
  const std::vector<Value> shuffled = {row[4], Value(9.0), row[2], row[0], row[3]};
  Sampled read;
  RowReader(describe(read), columns).read(shuffled);
  EXPECT_EQ(read.pixels, 7u);
  EXPECT_EQ(read.mae, 0.5) << "kept";
  EXPECT_EQ(read.rmse.value, 0.2);
  EXPECT_EQ(read.rmse.lower, 0.3);
  EXPECT_EQ(read.rmse.upper, 0.4);
}

TEST(Statistics, Over_no_pixels_real_numbers_are_no_numbers) {
  const std::vector<Value> row = row_of(Sampled{0, 0.0, {}});
  EXPECT_EQ(std::get<std::int64_t>(row[0]), 0);
  for (std::size_t i = 1; i < row.size(); ++i) EXPECT_TRUE(std::isnan(std::get<double>(row[i]))) << i;
}

TEST(Statistics, A_description_follows_the_object_that_it_is_bound_to) {
  Sampled sample;
  const Statistics described = describe(sample);
  sample.mae = 0.75;
  EXPECT_EQ(std::get<double>(row_of(described)[1]), 0.75);
  EXPECT_EQ(names_of(described, {&sample.rmse, &sample.mae}), (std::vector<std::string>{"rmse", "mae"}));
}

}  // namespace
}  // namespace umbrameter
