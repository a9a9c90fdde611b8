#include "compare/metrics/edges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace umbrameter {
namespace {

constexpr int reach = 32;        // px from the crossing to a plateau
constexpr float plateau = 0.1f;  // least distance from 0 or 1 that is still one
constexpr int further = 2;       // px on a plateau that belong to a profile
constexpr int fit_lines = 3;     // on each side, for the slope of an edge
constexpr double fewest_in_fit = 4.0;
constexpr double linked = 1.5;     // px between the crossings of neighbouring lines
constexpr std::size_t fewest = 8;  // points of an edge that has a roughness

// Rows or columns of both images as lines of pixels.
struct Lines {
  const MetricInput& input;
  bool are_rows = true;

  int count() const { return are_rows ? input.reference.height : input.reference.width; }
  int length() const { return are_rows ? input.reference.width : input.reference.height; }
  std::size_t index(int line, int at) const {
    return are_rows ? input.reference.index(at, line) : input.reference.index(line, at);
  }
  bool counts(int line, int at) const {
    return line >= 0 && line < count() && at >= 0 && at < length() && input.is_counted(index(line, at));
  }
  float reference(int line, int at) const { return input.reference[index(line, at)]; }
  float test(int line, int at) const { return input.test[index(line, at)]; }
};

struct Crossing {
  int line = 0;
  int before = 0;      // the reference passes ½ between this pixel and the next
  bool rises = false;  // from dark to lit
  double place = 0.0;  // along the line, px
  double moved = 0.0;  // along the line, px
  double width = 0.0;  // along the line, px
  double reference_width = 0.0;
  bool is_found = false;
  std::size_t edge = 0;
};

// Change of the reference along and across the lines about a crossing, from the halves of a window.
bool crosses_steeply(const Lines& lines, int line, int before) {
  double along = 0.0;
  double across = 0.0;
  for (int l = -fit_lines; l <= fit_lines; ++l) {
    for (int a = -fit_lines; a <= fit_lines + 1; ++a) {
      if (!lines.counts(line + l, before + a)) continue;
      const auto value = static_cast<double>(lines.reference(line + l, before + a));
      along += a > 0 ? value : -value;
      across += l > 0 ? value : l < 0 ? -value : 0.0;
    }
  }
  // Of a window of as many pixels: 7 lines of 8, of which the middle one has no part in the second sum.
  across *= 7.0 / 6.0;
  // Each edge is crossed in one direction; at 45° in rows.
  return lines.are_rows ? std::abs(along) >= std::abs(across) : std::abs(along) > std::abs(across);
}

bool is_on_plateau(float value, bool is_lit) { return is_lit ? value >= 1.0f - plateau : value <= plateau; }

// A little farther, where both images are still on it, for the last part of the profile; nothing where the pixels that
// count end.
std::optional<int> end_of_plateau(const Lines& lines, const Crossing& crossing, int at, int step) {
  const bool is_lit = crossing.rises == (step > 0);
  for (int i = 0; i < further; ++i) {
    const int next = at + step;
    if (!lines.counts(crossing.line, next)) return {};
    if (!is_on_plateau(lines.reference(crossing.line, next), is_lit) ||
        !is_on_plateau(lines.test(crossing.line, next), is_lit)) {
      break;
    }
    at = next;
  }
  return at;
}

// The pixel on one side of the crossing from which both images stay on a plateau.
std::optional<int> plateau_from(const Lines& lines, const Crossing& crossing, int step) {
  const bool is_lit = crossing.rises == (step > 0);
  for (int i = 0; i < reach; ++i) {
    const int at = crossing.before + (step > 0 ? 1 + i : -i);
    if (!lines.counts(crossing.line, at)) return {};
    const float reference = lines.reference(crossing.line, at);
    if ((reference >= 0.5f) != is_lit) return {};
    if (is_on_plateau(reference, is_lit) && is_on_plateau(lines.test(crossing.line, at), is_lit)) {
      return end_of_plateau(lines, crossing, at, step);
    }
  }
  return {};
}

// Where a profile passes a level between two pixels, searched from its dark end or from its lit one.
double passes(const std::vector<float>& from_dark, float level, bool from_lit) {
  const auto last = static_cast<int>(from_dark.size()) - 1;
  for (int i = 0; i < last; ++i) {
    const int low = from_lit ? last - 1 - i : i;
    const float a = from_dark[static_cast<std::size_t>(low)];
    const float b = from_dark[static_cast<std::size_t>(low) + 1];
    if (a < level && b >= level) return low + static_cast<double>((level - a) / (b - a));
  }
  return std::numeric_limits<double>::quiet_NaN();
}

// The middle third of a ramp, because a pixel beside its ends holds a part of them: with the levels ¼ and ¾ a ramp of
// 4 px would be 0.01 px too wide.
double ramp_width(const std::vector<float>& from_dark) {
  return std::max(0.0, 3.0 * (passes(from_dark, 2.0f / 3.0f, true) - passes(from_dark, 1.0f / 3.0f, false)));
}

void read_profile(const Lines& lines, Crossing& crossing) {
  const std::optional<int> first = plateau_from(lines, crossing, -1);
  const std::optional<int> last = plateau_from(lines, crossing, 1);
  if (!first || !last) return;
  std::vector<float> reference;
  std::vector<float> test;
  double darker = 0.0;
  double dark = 0.0;
  for (int at = *first; at <= *last; ++at) {
    reference.push_back(lines.reference(crossing.line, at));
    test.push_back(lines.test(crossing.line, at));
    darker += static_cast<double>(reference.back()) - static_cast<double>(test.back());
    dark += 1.0 - static_cast<double>(reference.back());
  }
  if (!crossing.rises) {
    std::reverse(reference.begin(), reference.end());
    std::reverse(test.begin(), test.end());
  }
  crossing.moved = darker;
  crossing.place = crossing.rises ? *first + dark : *last + 1 - dark;
  crossing.width = ramp_width(test);
  crossing.reference_width = ramp_width(reference);
  crossing.is_found = std::isfinite(crossing.width) && std::isfinite(crossing.reference_width);
}

std::vector<Crossing> crossings_of(const Lines& lines) {
  std::vector<Crossing> all;
  for (int line = 0; line < lines.count(); ++line) {
    for (int at = 0; at + 1 < lines.length(); ++at) {
      if (!lines.counts(line, at) || !lines.counts(line, at + 1)) continue;
      const bool is_lit = lines.reference(line, at) >= 0.5f;
      if (is_lit == (lines.reference(line, at + 1) >= 0.5f) || !crosses_steeply(lines, line, at)) continue;
      Crossing crossing{.line = line, .before = at, .rises = !is_lit, .place = at + 1.0};
      read_profile(lines, crossing);
      all.push_back(crossing);
    }
  }
  return all;
}

// Numbers the connected edges from `next` on, and returns the crossings of each in the order of their lines.
std::vector<std::vector<std::size_t>> connect(std::vector<Crossing>& all, std::size_t next) {
  std::vector<std::vector<std::size_t>> edges;
  std::size_t first_of_last = 0;  // crossings of the line before
  std::size_t first_of_line = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (i > 0 && all[i].line != all[i - 1].line) {
      first_of_last = all[i].line == all[i - 1].line + 1 ? first_of_line : i;
      first_of_line = i;
    }
    std::size_t nearest = all.size();
    double least = linked;
    for (std::size_t j = first_of_last; j < first_of_line; ++j) {
      const double gap = std::abs(all[j].place - all[i].place);
      const bool is_taken = edges[all[j].edge - next].back() != j;
      if (all[j].rises != all[i].rises || is_taken || gap > least) continue;
      least = gap;
      nearest = j;
    }
    if (nearest == all.size()) {
      all[i].edge = next + edges.size();
      edges.emplace_back();
    } else {
      all[i].edge = all[nearest].edge;
    }
    edges[all[i].edge - next].push_back(i);
  }
  return edges;
}

// How far an edge moves along the lines from one line to the next, from a straight line through the places found near
// one of its crossings; nothing where they are too few.
std::optional<double> slope_at(const std::vector<Crossing>& all, const std::vector<std::size_t>& edge, std::size_t at) {
  const std::size_t begin = at < fit_lines ? 0 : at - fit_lines;
  const std::size_t end = std::min(edge.size(), at + fit_lines + 1);
  double sum_line = 0.0;
  double sum_place = 0.0;
  double count = 0.0;
  for (std::size_t i = begin; i < end; ++i) {
    if (!all[edge[i]].is_found) continue;
    sum_line += all[edge[i]].line;
    sum_place += all[edge[i]].place;
    ++count;
  }
  if (count < fewest_in_fit) return {};
  double squares = 0.0;
  double products = 0.0;
  for (std::size_t i = begin; i < end; ++i) {
    if (!all[edge[i]].is_found) continue;
    const double line = all[edge[i]].line - sum_line / count;
    squares += line * line;
    products += line * (all[edge[i]].place - sum_place / count);
  }
  return squares > 0.0 ? products / squares : 0.0;
}

// A map of a value of the found points, and the details that all metrics of edges report.
MetricResult measure_points(const MetricInput& input, const std::vector<EdgePoint>& points,
                            const std::vector<double>& values) {
  Image<float> map(input.reference.width, input.reference.height, std::numeric_limits<float>::quiet_NaN());
  double found = 0.0;
  double width = 0.0;
  double reference_width = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].is_found) continue;
    ++found;
    width += points[i].width;
    reference_width += points[i].reference_width;
    map[points[i].pixel] = static_cast<float>(values[i]);
  }
  MetricResult result = mean_of_map(std::move(map), [](std::size_t) { return true; });
  result.details = {{"edge points", static_cast<double>(points.size())},
                    {"share of them found", found / static_cast<double>(points.size())},
                    {"penumbra width [px]", width / found},
                    {"penumbra width of the reference [px]", reference_width / found}};
  return result;
}

// The lengths of the points in px, or in another unit by a factor for each.
using Values = std::vector<double> (*)(const std::vector<EdgePoint>& points, const std::vector<double>& factors);

MetricResult measure_lengths(const MetricInput& input, const std::vector<EdgePoint>& points, Values values_of) {
  MetricResult result = measure_points(input, points, values_of(points, std::vector<double>(points.size(), 1.0)));
  if (!input.edge_scale) return result;
  std::vector<double> texels(points.size(), 0.0);
  std::vector<double> metres(points.size(), 0.0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].is_found) continue;
    const LengthFactors factors = input.edge_scale(points[i].pixel, points[i].tangent);
    texels[i] = factors.texels;
    metres[i] = factors.metres;
  }
  for (const std::vector<double>& factors : {texels, metres}) {
    result.in_other_units.push_back(measure_points(input, points, values_of(points, factors)).score);
  }
  return result;
}

MetricResult measure_displacement(const MetricInput& input) {
  return measure_lengths(input, find_edge_points(input), [](const auto& points, const auto& factors) {
    std::vector<double> values;
    for (std::size_t i = 0; i < points.size(); ++i) values.push_back(factors[i] * points[i].displacement);
    return values;
  });
}

// The squares of the distances from the mean of each edge.
std::vector<double> squares_about_mean(const std::vector<EdgePoint>& points, const std::vector<double>& factors) {
  struct Sum {
    double displacement = 0.0;
    double count = 0.0;
  };
  std::vector<Sum> sums;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (sums.size() <= points[i].edge) sums.resize(points[i].edge + 1);
    if (!points[i].is_found) continue;
    sums[points[i].edge].displacement += factors[i] * points[i].displacement;
    ++sums[points[i].edge].count;
  }
  std::vector<double> values;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Sum& sum = sums[points[i].edge];
    const double about = factors[i] * points[i].displacement - sum.displacement / std::max(sum.count, 1.0);
    values.push_back(about * about);
  }
  return values;
}

MetricResult measure_roughness(const MetricInput& input) {
  std::vector<EdgePoint> points = find_edge_points(input);
  std::vector<std::size_t> counts;
  for (const EdgePoint& point : points) {
    if (counts.size() <= point.edge) counts.resize(point.edge + 1);
    if (point.is_found) ++counts[point.edge];
  }
  for (EdgePoint& point : points) point.is_found = point.is_found && counts[point.edge] >= fewest;
  MetricResult result = measure_lengths(input, points, squares_about_mean);
  result.score = std::sqrt(result.score);
  for (double& score : result.in_other_units) score = std::sqrt(score);
  return result;
}

MetricResult measure_width(const MetricInput& input) {
  return measure_lengths(input, find_edge_points(input), [](const auto& points, const auto& factors) {
    std::vector<double> values;
    for (std::size_t i = 0; i < points.size(); ++i) {
      values.push_back(factors[i] * (points[i].width - points[i].reference_width));
    }
    return values;
  });
}

MetricResult measure_found(const MetricInput& input) {
  Image<float> map(input.reference.width, input.reference.height, std::numeric_limits<float>::quiet_NaN());
  for (const EdgePoint& point : find_edge_points(input)) map[point.pixel] = point.is_found ? 1.0f : 0.0f;
  return mean_of_map(std::move(map), [](std::size_t) { return true; });
}

// In the order of LengthFactors.
constexpr std::array<std::string_view, 2> edge_units = {"texels", "m"};

}  // namespace

std::vector<EdgePoint> find_edge_points(const MetricInput& input) {
  std::vector<EdgePoint> points;
  std::size_t edges = 0;
  for (const bool are_rows : {true, false}) {
    const Lines lines{input, are_rows};
    std::vector<Crossing> all = crossings_of(lines);
    const std::vector<std::vector<std::size_t>> connected = connect(all, edges);
    for (const std::vector<std::size_t>& edge : connected) {
      for (std::size_t i = 0; i < edge.size(); ++i) {
        const Crossing& crossing = all[edge[i]];
        const std::optional<double> slope = slope_at(all, edge, i);
        const double cosine = slope ? 1.0 / std::sqrt(1.0 + *slope * *slope) : 0.0;
        const dvec2 tangent = are_rows ? dvec2(slope.value_or(0.0), 1.0) : dvec2(1.0, slope.value_or(0.0));
        points.push_back({lines.index(crossing.line, crossing.before), crossing.is_found && slope.has_value(),
                          cosine * crossing.moved, cosine * crossing.width, cosine * crossing.reference_width,
                          cosine * tangent, crossing.edge});
      }
    }
    edges += connected.size();
  }
  return points;
}

const Metric edge_displacement_metric = {"edge-displacement",
                                         "mean displacement of edges",
                                         "px",
                                         "any; 0 is in place, above 0 shadows are larger",
                                         "mean over the reference's edges of how far they moved into the light",
                                         "slanted-edge analysis as in ISO 12233, here by the light under each row",
                                         false,
                                         measure_displacement,
                                         ColorRule::display_luma,
                                         nullptr,
                                         edge_units};

const Metric edge_roughness_metric = {"edge-roughness",
                                      "roughness of edges",
                                      "px",
                                      "0 and up, 0 is as straight as the reference",
                                      "RMS of the displacement about the mean of each connected edge",
                                      "line edge roughness as in SEMI P47, about the reference's edge",
                                      false,
                                      measure_roughness,
                                      ColorRule::display_luma,
                                      nullptr,
                                      edge_units};

const Metric edge_width_metric = {
    "edge-width",
    "change of the width of penumbrae",
    "px",
    "any; 0 is as wide as the reference, above 0 is softer",
    "mean over the reference's edges of the width (three times the distance from a third to two thirds) "
    "less the reference's",
    "edge width as in ISO 12233's edge spread",
    false,
    measure_width,
    ColorRule::display_luma,
    nullptr,
    edge_units};

const Metric edges_found_metric = {.name = "edges-found",
                                   .title = "share of the reference's edges that were found",
                                   .unit = "1",
                                   .range = "0 to 1, 1 is all of them",
                                   .formula = "edge points at which both images have an edge, of all of the reference",
                                   .source = "what the other metrics of edges are means over",
                                   .is_higher_better = true,
                                   .measure = measure_found,
                                   .color_rule = ColorRule::display_luma};

}  // namespace umbrameter
