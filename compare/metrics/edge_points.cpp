#include "compare/metrics/edge_points.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace umbrameter {
namespace {

constexpr int reach = 32;        // px from the crossing to a plateau
constexpr float plateau = 0.1f;  // least distance from 0 or 1 that is still one
constexpr int further = 2;       // px on a plateau that belong to a profile
constexpr double linked = 1.5;   // px between the crossings of neighbouring lines

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
  for (int l = -edge_lines; l <= edge_lines; ++l) {
    for (int a = -edge_lines; a <= edge_lines + 1; ++a) {
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

// The distance between two levels about ½, as the width of the ramp from 0 to 1 with that slope.
double width_between(const std::vector<float>& from_dark, float dark_level) {
  const float lit_level = 1.0f - dark_level;
  const double distance = passes(from_dark, lit_level, true) - passes(from_dark, dark_level, false);
  return std::max(0.0, distance / static_cast<double>(lit_level - dark_level));
}

// Pixels at the ends of a ramp also cover what is beside it, which makes it look wider. In a ramp of four pixels or
// more the middle third is free of them, in a shorter one a smaller part about ½.
double ramp_width(const std::vector<float>& from_dark) {
  constexpr double free_third = 4.0;   // px
  constexpr double free_middle = 3.0;  // px
  const double estimate = width_between(from_dark, 1.0f / 3.0f);
  if (!(estimate < free_third)) return estimate;
  const double share = std::max(0.02, (estimate - free_middle) / (free_third - free_middle) / 3.0);
  return width_between(from_dark, static_cast<float>(0.5 - 0.5 * share));
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
    std::ranges::reverse(reference);
    std::ranges::reverse(test);
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
  const std::size_t begin = at < edge_lines ? 0 : at - edge_lines;
  const std::size_t end = std::min(edge.size(), at + edge_lines + 1);
  double sum_line = 0.0;
  double sum_place = 0.0;
  double count = 0.0;
  for (std::size_t i = begin; i < end; ++i) {
    if (!all[edge[i]].is_found) continue;
    sum_line += all[edge[i]].line;
    sum_place += all[edge[i]].place;
    ++count;
  }
  if (count < fewest_edge_lines) return {};
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

}  // namespace umbrameter
