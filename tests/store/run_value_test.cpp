// RunResults as bytes and back, without anything that draws or traces.
#include "store/run_value.h"

#include <gtest/gtest.h>

#include "store/value_archive.h"
#include "tests/store/small_store.h"
#include "tests/support/temporary_folder.h"

namespace umbrameter {
namespace {

struct Part {
  std::vector<int> numbers = {7};
  std::optional<std::string> text;
};
struct Whole {
  std::variant<std::monostate, double, Part> choice;
  std::map<std::string, std::pair<bool, float>> named;
  Image<std::uint16_t> image;
  std::array<double, 2> pair{};
  std::vector<Part> parts;
};

TEST(ValueArchive, Gives_back_every_field_of_nested_structs) {
  Whole whole;
  whole.choice = Part{{}, "ä"};
  whole.named["a"] = {true, std::numeric_limits<float>::infinity()};
  whole.image = Image<std::uint16_t>(2, 3, std::uint16_t{5});
  whole.pair = {1.5, -0.0};
  whole.parts = {Part{{1, 2}, {}}};
  const std::string bytes = archive::Writer().put(whole).take();
  archive::Reader reader(bytes);
  const Whole read = reader.get<Whole>();
  EXPECT_TRUE(reader.is_at_end());
  EXPECT_TRUE(std::get<Part>(read.choice).numbers.empty()) << "the default value must give way";
  EXPECT_EQ(std::get<Part>(read.choice).text, "ä");
  EXPECT_EQ(read.named, whole.named);
  EXPECT_EQ(read.image, whole.image);
  EXPECT_EQ(read.pair, whole.pair);
  EXPECT_EQ(read.parts.at(0).numbers, std::vector<int>({1, 2}));
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    archive::Reader shorter(std::string_view(bytes).substr(0, size));
    EXPECT_THROW(shorter.get<Whole>(), std::runtime_error) << size;
  }
}

TEST(ValueArchive, Knows_structs_apart_by_their_fields) {
  const auto layout = [](auto value) {
    std::string text;
    archive::add_layout<decltype(value)>(text);
    return text;
  };
  struct Before {
    int a;
    std::vector<double> b;
  };
  struct After {
    int a;
    std::vector<float> b;
  };
  EXPECT_NE(layout(Before{}), layout(After{}));
  EXPECT_EQ(layout(Part{}), "{si4ot}");
}

RunResults made_results() {
  RunResults results;
  results.command = "compare";
  results.experiment.scene = "made";
  results.notes = {"a unit was assumed"};
  results.scene.titles = {"sun"};
  Measurement& measurement = results.measurement.emplace();
  add_layer(measurement.layers, "truth_ao", Image<float>(2, 1, 0.25f));
  add_layer(measurement.layers, "gbuffer_position", Image<vec3>(2, 1, vec3(1, 2, 3)));
  measurement.surfels.gbuffer.width = 2;
  measurement.surfels.gbuffer.height = 1;
  measurement.surfels.gbuffer.instance = Image<std::uint32_t>(2, 1, 4u);
  AoMeasurement& ao = measurement.ao.emplace();
  ao.statistics.emplace().error.mae = {0.1, 0.05, 0.15};
  ao.metrics.push_back({columns_of(ssim_metric, false).front(), 0.5});
  return results;
}

TEST(RunValue, Comes_back_whole_with_the_layers_of_the_image_in_their_order) {
  const TemporaryFolder folder;
  RunResults results = made_results();
  write_run_value(folder.path(), results);
  EXPECT_EQ(results.measurement->layers.channels.size(), 4u) << "the layers stay";
  write_exr(folder / "images.exr", results.measurement->layers);
  const std::optional<RunResults> read = read_run_value(folder.path());
  ASSERT_TRUE(read);
  EXPECT_EQ(read->command, "compare");
  EXPECT_EQ(read->notes, results.notes);
  EXPECT_EQ(read->measurement->surfels.gbuffer.instance, results.measurement->surfels.gbuffer.instance);
  const AoMeasurement& ao = *read->measurement->ao;
  EXPECT_EQ(ao.statistics->error.mae.upper, 0.15);
  EXPECT_EQ(ao.metrics.at(0).column.metric->name, ssim_metric.name);
  const std::vector<Channel>& channels = read->measurement->layers.channels;
  ASSERT_EQ(channels.size(), 4u);
  EXPECT_EQ(channels[0].name, "truth_ao.Y");
  EXPECT_EQ(channels[3].name, "gbuffer_position.Z");
  EXPECT_EQ(channels[3].values[1], 3.0f);
}

TEST(RunValue, Without_a_file_or_of_another_version_is_nothing) {
  const TemporaryFolder folder;
  EXPECT_FALSE(read_run_value(folder.path()));
  put_text(folder / run_value_file, "umbrameter run\nof long ago");
  EXPECT_FALSE(read_run_value(folder.path()));
}

TEST(RunValue, That_is_cut_off_or_has_a_flipped_bit_is_an_error_that_names_it) {
  const TemporaryFolder folder;
  RunResults results = made_results();
  results.measurement.reset();
  write_run_value(folder.path(), results);
  const std::string whole = text_of(folder / run_value_file);
  constexpr std::size_t head = 15 + 32;  // which say that it is of this version
  for (std::size_t place = head; place < whole.size(); place += 7) {
    put_text(folder / run_value_file, whole.substr(0, place));
    expect_error([&] { read_run_value(folder.path()); }, ExitCode::unreadable_input, {run_value_file});
    std::string flipped = whole;
    flipped[place] = static_cast<char>(flipped[place] ^ 1);
    put_text(folder / run_value_file, flipped);
    expect_error([&] { read_run_value(folder.path()); }, ExitCode::unreadable_input, {run_value_file, "rerun"});
  }
}

}  // namespace
}  // namespace umbrameter
