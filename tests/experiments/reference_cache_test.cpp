// What the cache returns is the traced result bit for bit, or a fresh one.
#include "experiments/stages/reference_cache.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>

#include "tests/support/temporary_folder.h"

namespace umbrameter {
namespace {

constexpr int width = 5;
constexpr int height = 3;

// Every bit pattern must survive: a signalling NaN, -0, a denormal and an infinity among them.
Image<float> make_image(std::uint32_t last) {
  const std::uint32_t patterns[] = {0x7fa00001u, 0x80000000u, 0x00000001u, 0x7f800000u, last};
  Image<float> image(width, height);
  for (std::size_t i = 0; i < image.size(); ++i) std::memcpy(&image[i], &patterns[i % 5], sizeof(float));
  return image;
}

SamplingPrecision make_precision() { return {9007199254740993u, 0.1, std::numeric_limits<double>::infinity(), 64, 3}; }

TracedAo make_ao() {
  return {make_image(1),
          make_image(2),
          make_image(3),
          make_image(4),
          Image<vec3>(width, height, vec3(1.0f, -2.0f, 0.1f)),
          {},
          63,
          make_precision(),
          {12345678901u, 0.1, 1e-300, false}};
}

TracedVisibility make_visibility() {
  return {make_image(1), {7, 0.2, 1e-7, false}, make_image(2), make_image(3), make_image(4), 31, make_precision()};
}

template <class T>
bool equal_bits(const Image<T>& a, const Image<T>& b) {
  return a.width == b.width && a.height == b.height && a.size() == b.size() &&
         (a.empty() || std::memcmp(a.pixels.data(), b.pixels.data(), a.size() * sizeof(T)) == 0);
}

void expect_equal(const SamplingPrecision& a, const SamplingPrecision& b) {
  EXPECT_EQ(a.pixels, b.pixels);
  EXPECT_EQ(a.worst_half_width, b.worst_half_width);
  EXPECT_EQ(a.mean_half_width, b.mean_half_width);
  EXPECT_EQ(a.mean_samples, b.mean_samples);
  EXPECT_EQ(a.pixels_at_limit, b.pixels_at_limit);
}

void expect_equal(const TraceStatistics& a, const TraceStatistics& b) {
  EXPECT_EQ(a.rays, b.rays);
  EXPECT_EQ(a.seconds, b.seconds);
  EXPECT_EQ(a.largest_offset, b.largest_offset);
}

class ReferenceCacheTest : public testing::Test {
 protected:
  // A second cache object reads it, as another run does.
  template <class Traced>
  Traced get(const std::string& kind, const Traced& traced) {
    const std::function<Traced()> trace = [&] {
      ++traces_;
      return traced;
    };
    return ReferenceCache(folder_, Console{true}).get({kind, "", "", "", "", "", 1}, {"scene", "what"}, trace);
  }

  TemporaryFolder home_;
  CacheFolder folder_{home_ / "references"};
  int traces_ = 0;
};

TEST_F(ReferenceCacheTest, Every_bit_of_an_ambient_occlusion_comes_back) {
  const TracedAo traced = make_ao();
  EXPECT_FALSE(get("ao", traced).statistics.from_cache);
  const TracedAo cached = get("ao", TracedAo{});
  EXPECT_EQ(traces_, 1);
  EXPECT_TRUE(cached.statistics.from_cache);
  EXPECT_TRUE(equal_bits(cached.ao, traced.ao));
  EXPECT_TRUE(equal_bits(cached.standard_error, traced.standard_error));
  EXPECT_TRUE(equal_bits(cached.variance, traced.variance));
  EXPECT_TRUE(equal_bits(cached.samples, traced.samples));
  EXPECT_TRUE(equal_bits(cached.bent_normal, traced.bent_normal));
  EXPECT_TRUE(equal_bits(cached.hit_distance, traced.hit_distance)) << "an empty image stays empty";
  EXPECT_EQ(cached.degrees_of_freedom, 63);
  expect_equal(cached.precision, traced.precision);
  expect_equal(cached.statistics, traced.statistics);
}

TEST_F(ReferenceCacheTest, Every_bit_of_a_visibility_comes_back) {
  const TracedVisibility traced = make_visibility();
  get("visibility", traced);
  const TracedVisibility cached = get("visibility", TracedVisibility{});
  EXPECT_EQ(traces_, 1);
  EXPECT_TRUE(cached.statistics.from_cache);
  EXPECT_TRUE(equal_bits(cached.visibility, traced.visibility));
  EXPECT_TRUE(equal_bits(cached.standard_error, traced.standard_error));
  EXPECT_TRUE(equal_bits(cached.variance, traced.variance));
  EXPECT_TRUE(equal_bits(cached.samples, traced.samples));
  EXPECT_EQ(cached.degrees_of_freedom, 31);
  expect_equal(cached.precision, traced.precision);
  expect_equal(cached.statistics, traced.statistics);
}

TEST_F(ReferenceCacheTest, Content_that_does_not_fit_is_traced_again) {
  get("other kind", make_ao());
  EXPECT_TRUE(equal_bits(get("other kind", make_visibility()).visibility, make_visibility().visibility));
  EXPECT_EQ(traces_, 2);
  EXPECT_TRUE(get("other kind", make_visibility()).statistics.from_cache);
  EXPECT_EQ(traces_, 2);
}

TEST_F(ReferenceCacheTest, Without_a_folder_it_always_traces) {
  for (const std::optional<CacheFolder>& folder : {std::optional<CacheFolder>(), {CacheFolder{home_ / "none", 0}}}) {
    ReferenceCache cache(folder, Console{true});
    EXPECT_FALSE(cache.enabled());
    int traces = 0;
    const std::function<TracedAo()> trace = [&] {
      ++traces;
      return make_ao();
    };
    for (int i = 0; i < 2; ++i) cache.get({"ao", "", "", "", "", "", 1}, {"scene", "what"}, trace);
    EXPECT_EQ(traces, 2);
  }
  EXPECT_FALSE(std::filesystem::exists(home_ / "none"));
}

}  // namespace
}  // namespace umbrameter
