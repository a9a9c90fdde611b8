#include "experiments/measure/bias_terms.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "core/error.h"

namespace umbrameter {
namespace {

bool are_equal(std::span<const double> values, double tolerance = 1e-9) {
  const auto is_near = [&](double value) { return std::abs(value - values[0]) <= tolerance * std::abs(values[0]); };
  return std::ranges::all_of(values, is_near);
}

// A term at each place, also over the size of a texel and over the range of depth there.
struct AtPlaces {
  std::vector<double> metres;
  std::vector<double> texels;
  std::vector<double> depths;
  AtPlaces(const std::vector<MapPlace>& places, const std::vector<BiasTerms>& terms, double BiasTerms::*term) {
    for (std::size_t i = 0; i < places.size(); ++i) {
      metres.push_back(terms[i].*term);
      texels.push_back(metres.back() / places[i].texel);
      depths.push_back(metres.back() / places[i].range);
    }
  }
};

// Sets the constant bias; false where no parameter can say it.
bool set_constant(Experiment& experiment, const MapLayout& layout, const AtPlaces& bias) {
  Length& constant = experiment.shadow.bias.constant;
  std::string& factors = experiment.shadow.fit.cascade_bias;
  if (factors != own_range) factors.clear();
  if (are_equal(bias.metres)) {
    constant = Length{bias.metres[0]};
  } else if (are_equal(bias.texels)) {
    constant = {bias.texels[0], LengthUnit::texels};
  } else if (are_equal(bias.depths)) {
    constant = {bias.depths[0], LengthUnit::map_depth};
  } else if (has_equal_texels(layout) &&
             std::ranges::all_of(bias.metres, [&](double metres) { return metres * bias.metres[0] > 0.0; })) {
    constant = Length{bias.metres[0]};
    factors.clear();
    // Cascades that are no finer than the last are left out of the layout, before the last.
    for (int i = 0; i < experiment.shadow.map.cascades; ++i) {
      const bool is_last = i + 1 == experiment.shadow.map.cascades;
      const std::size_t view =
          is_last ? bias.metres.size() - 1 : std::min(static_cast<std::size_t>(i), bias.metres.size() - 1);
      factors += fmt::format("{}{}", factors.empty() ? "" : ",", bias.metres[view] / bias.metres[0]);
    }
  } else {
    return false;
  }
  return true;
}

}  // namespace

std::vector<BiasTerms> terms_of(const Experiment& experiment, const MapLayout& layout,
                                const std::vector<MapPlace>& places) {
  const NormalOffset& receiver = experiment.shadow.bias.normal_offset;
  const NormalOffset& caster = experiment.shadow.map_depth.caster_offset;
  if (!is_none(receiver) && !is_none(caster)) {
    throw Error(ExitCode::usage, "--for", "no engine moves both receivers and casters along their normals",
                "set shadow.normal-offset or shadow.caster-offset to 0, in texels and in metres");
  }
  const bool moves_caster = !is_none(caster);
  const NormalOffset& offset = moves_caster ? caster : receiver;
  const OffsetKind kind{offset.profile, moves_caster ? OffsetSide::caster : OffsetSide::receiver,
                        moves_caster ? OffsetDirection::normal : experiment.shadow.bias.offset_direction,
                        experiment.shadow.bias.offset_facing};
  const Length& constant = experiment.shadow.bias.constant;
  std::vector<BiasTerms> terms;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double unit = constant.unit == LengthUnit::texels      ? places[i].texel
                        : constant.unit == LengthUnit::map_depth ? places[i].range
                                                                 : 1.0;
    const double factor = has_equal_texels(layout) ? layout.views[i].bias_factor : 1.0;
    terms.push_back({constant.number * unit * factor, offset.texels * places[i].texel + offset.metres, kind,
                     experiment.shadow.map_depth.polygon_offset_factor});
  }
  return terms;
}

std::optional<Experiment> with_terms(Experiment experiment, const MapLayout& layout,
                                     const std::vector<MapPlace>& places, const std::vector<BiasTerms>& terms,
                                     std::string& reason) {
  if (!set_constant(experiment, layout, AtPlaces(places, terms, &BiasTerms::constant))) {
    reason =
        "their bias is another length at each distance from the light, which our rasteriser cannot draw on this map";
    if (layout.kind == MapKind::perspective && layout.encoded_near == 0.0)
      reason += "; --shadow.depth-encoding perspective makes it possible";
    return {};
  }
  const AtPlaces normal(places, terms, &BiasTerms::normal);
  NormalOffset offset{0.0, 0.0, terms[0].offset.profile};
  // Three digits, rounded up, are at most a hundredth apart.
  constexpr double rounding = 0.01;
  if (are_equal(normal.metres, rounding)) {
    offset.metres = normal.metres[0];
  } else if (are_equal(normal.texels, rounding)) {
    offset.texels = normal.texels[0];
  } else {
    reason = "its normal offset is proportional neither to texels nor to metres";
    return {};
  }
  const bool moves_caster = terms[0].offset.side == OffsetSide::caster;
  experiment.shadow.bias.normal_offset = moves_caster ? NormalOffset{0.0, 0.0, offset.profile} : offset;
  experiment.shadow.map_depth.caster_offset = moves_caster ? offset : NormalOffset{};
  experiment.shadow.bias.offset_direction = terms[0].offset.direction;
  experiment.shadow.bias.offset_facing = terms[0].offset.facing;
  experiment.shadow.map_depth.polygon_offset_factor = terms[0].slope;
  experiment.shadow.bias.slope = 0.0;  // no term
  return experiment;
}

}  // namespace umbrameter
