#include "reports/page/viewer_data.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "reports/page/cells.h"

namespace umbrameter {
namespace {

ViewerData viewer_sample() {
  ViewerData data;
  data.width = 2;
  data.height = 1;
  data.layers = {{"e", "Error", "sun", ViewerRole::error, ViewerKind::error, 0.5}};
  data.layers[0].planes = {Image<float>(2, 1, 0.25f)};
  data.objects = {Image<std::uint16_t>(2, 1, 1), {"floor"}};
  return data;
}

TEST(ViewerData, What_sets_of_images_share_is_held_once) {
  ViewerPack pack;
  add_set(pack, viewer_sample());
  const std::size_t items = pack.items.size();
  add_set(pack, viewer_sample());
  EXPECT_EQ(pack.items.size(), items);
  ViewerData other = viewer_sample();
  other.layers[0].planes[0][0] = 0.75f;
  add_set(pack, other);
  EXPECT_EQ(pack.items.size(), items + 1);
  EXPECT_EQ(pack.sets.size(), 3u);
}

TEST(ViewerData, A_rounded_set_leaves_out_the_error_that_is_a_difference) {
  ViewerData data = viewer_sample();
  data.layers = {{"t", "t", "g", ViewerRole::reference, ViewerKind::share},
                 {"r", "r", "g", ViewerRole::technique, ViewerKind::share},
                 {"e", "e", "g", ViewerRole::error, ViewerKind::error}};
  for (ViewerLayer& layer : data.layers) layer.planes = {Image<float>(2, 1, 0.25f)};
  for (const bool is_rounded : {false, true}) {
    data.rounded = is_rounded;
    ViewerPack pack;
    add_set(pack, data);
    const nlohmann::json set = nlohmann::json::parse(pack.sets[0]);
    EXPECT_EQ(set["layers"][2]["planes"].size(), is_rounded ? 0u : 1u);
  }
}

TEST(ViewerData, Beyond_1920_by_1080_the_viewer_has_every_second_pixel_unless_all_are_asked_for) {
  const auto stride_of = [](int width, int height, bool is_full) {
    ViewerData data = viewer_sample();
    data.width = width;
    data.height = height;
    data.full = is_full;
    ViewerPack pack;
    add_set(pack, data);
    return nlohmann::json::parse(pack.sets[0])["stride"].get<int>();
  };
  EXPECT_EQ(stride_of(1280, 720, false), 1);
  EXPECT_EQ(stride_of(1920, 1080, false), 1);
  EXPECT_EQ(stride_of(1921, 1080, false), 2);
  EXPECT_EQ(stride_of(3840, 2160, true), 1);
}

TEST(ReportCells, Values_are_exact_along_the_axes_and_have_eight_digits_elsewhere) {
  ReportCells cells;
  cells.table.columns = {{"shadow.constant-bias", "m", ""}, {"mae", "1", ""}};
  cells.table.rows = {{0.1234567890123, 0.1234567890123}, {std::string("word"), std::nan("")}};
  cells.axes = 1;
  const nlohmann::json data = nlohmann::json::parse(cells_json(cells).dump());
  EXPECT_EQ(data["rows"][0], (nlohmann::json{0.1234567890123, 0.12345679}));
  EXPECT_EQ(data["rows"][1][0], "word");
  EXPECT_TRUE(data["rows"][1][1].is_null());
}

TEST(ReportCells, A_chart_names_its_columns_among_those_of_the_cells) {
  const ChartCells chart{"mae", {{"bias", "shadow.constant-bias"}}, {{"shadow.resolution", std::int64_t{512}}}};
  EXPECT_EQ(chart_cells_json(chart).dump(),
            R"({"columns":{"bias":"shadow.constant-bias"},"fixed":{"shadow.resolution":512}})");
}

}  // namespace
}  // namespace umbrameter
