#include "raytrace/ao_samples.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/random.h"

namespace umbrameter {
namespace {

// Parts of the disk's square in each direction by which a pixel's points are put in order.
constexpr int strata = 16;

int part_of(float coordinate) {
  return std::clamp(static_cast<int>((coordinate + 1.0f) * (0.5f * strata)), 0, strata - 1);
}

// Strata row by row, back and forth, so that neighbours follow one another.
std::uint16_t stratum_of(vec2 disk) {
  const int row = part_of(disk.y);
  const int column = part_of(disk.x);
  return static_cast<std::uint16_t>(row * strata + (row % 2 == 0 ? column : strata - 1 - column));
}

}  // namespace

void PixelSamples::make(Sampler sampler, const SampleRange& range, std::uint32_t stream) {
  unsorted_.clear();
  std::array<int, strata * strata + 1> first{};
  const Randomisations before{range.split.count, range.begin};
  for (int r = 0; r < range.split.count; ++r) {
    const std::uint32_t scramble = hash(stream, static_cast<std::uint32_t>(r));
    // Turned at random: edges that run through the middle of the disk or along the square's sides would else have
    // the same count in every randomisation, or one of two, and such counts are far from a normal distribution.
    const float angle = static_cast<float>(2.0 * pi) * to_unit_float(hash(scramble, 2u));
    const vec2 turn(std::cos(angle), std::sin(angle));
    for (int i = before.size(r); i < range.split.size(r); ++i) {
      const auto index = static_cast<std::uint32_t>(i);
      const vec2 d =
          concentric_disk(sampler == Sampler::owen ? owen_sobol(index, scramble) : random_point(index, scramble));
      const vec2 disk(d.x * turn.x - d.y * turn.y, d.x * turn.y + d.y * turn.x);
      unsorted_.push_back({disk, static_cast<std::uint16_t>(r), stratum_of(disk)});
      ++first[unsorted_.back().stratum + 1u];
    }
  }
  for (std::size_t s = 1; s < first.size(); ++s) first[s] += first[s - 1];
  sorted_.resize(unsorted_.size());
  for (const Sample& sample : unsorted_) sorted_[static_cast<std::size_t>(first[sample.stratum]++)] = sample;
}

}  // namespace umbrameter
