#include "compare/shadow_edges.h"

#include <cassert>
#include <cmath>
#include <limits>
#include <vector>

#include "core/parallel.h"

namespace umbrameter {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr int nowhere = -1;

// Lengths are in half pixels, so that the middles between pixels fall on whole numbers: every square is exact.
struct Direction {
  int bit = 0;
  int right = 0;  ///< half pixels from the pixel to the edge
  int down = 0;
};

// The row of the nearest edge in each pixel's own column.
Image<int> nearest_rows(const ShadowEdges& edges, const Direction& direction) {
  const int width = edges.bits.width;
  const int height = edges.bits.height;
  Image<int> nearest(width, height, nowhere);
  std::vector<int> last(static_cast<std::size_t>(width), nowhere);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      int& row = last[static_cast<std::size_t>(x)];
      if ((edges.bits.at(x, y) >> direction.bit & 1) != 0) row = y;
      nearest.at(x, y) = row;
    }
  }
  std::ranges::fill(last, nowhere);
  for (int y = height - 1; y >= 0; --y) {
    for (int x = 0; x < width; ++x) {
      int& row = last[static_cast<std::size_t>(x)];
      if ((edges.bits.at(x, y) >> direction.bit & 1) != 0) row = y;
      int& above = nearest.at(x, y);
      if (row != nowhere && (above == nowhere || 2 * (row - y) + direction.down < 2 * (y - above) - direction.down)) {
        above = row;
      }
    }
  }
  return nearest;
}

// A parabola over a row: the squared distance to one column's nearest edge.
struct Parabola {
  int column = 0;
  std::int64_t place = 0;    ///< of its vertex, half pixels
  std::int64_t height = 0;   ///< half pixels squared
  double first = -infinity;  ///< where it becomes the lowest
};

class Envelope {
 public:
  void clear() { parabolas_.clear(); }
  bool empty() const { return parabolas_.empty(); }

  /// By rising places.
  void add(Parabola parabola) {
    while (!parabolas_.empty()) {
      const Parabola& last = parabolas_.back();
      const std::int64_t rise =
          parabola.height + parabola.place * parabola.place - last.height - last.place * last.place;
      parabola.first = static_cast<double>(rise) / static_cast<double>(2 * (parabola.place - last.place));
      if (parabola.first > last.first) break;
      parabolas_.pop_back();
    }
    if (parabolas_.empty()) parabola.first = -infinity;
    parabolas_.push_back(parabola);
  }

  /// Calls visit(pixel's column, lowest parabola) from left to right.
  template <class Visit>
  void walk(int width, const Visit& visit) const {
    std::size_t k = 0;
    for (int x = 0; x < width; ++x) {
      while (k + 1 < parabolas_.size() && parabolas_[k + 1].first < 2.0 * x) ++k;
      visit(x, parabolas_[k]);
    }
  }

 private:
  std::vector<Parabola> parabolas_;
};

void take_nearer(const ShadowEdges& edges, const Direction& direction, Image<std::int64_t>& squares,
                 NearestEdges& nearest) {
  const Image<int> rows = nearest_rows(edges, direction);
  const int width = edges.bits.width;
  parallel_for(static_cast<std::size_t>(edges.bits.height), [&](std::size_t row) {
    const int y = static_cast<int>(row);
    Envelope envelope;
    for (int x = 0; x < width; ++x) {
      const int edge_row = rows.at(x, y);
      if (edge_row == nowhere) continue;
      const std::int64_t away = 2 * (edge_row - y) + direction.down;
      envelope.add({x, 2 * x + direction.right, away * away, -infinity});
    }
    if (envelope.empty()) return;
    envelope.walk(width, [&](int x, const Parabola& lowest) {
      const std::int64_t across = std::int64_t{2} * x - lowest.place;
      const std::int64_t square = across * across + lowest.height;
      std::int64_t& least = squares.at(x, y);
      if (square >= least) return;
      least = square;
      const std::size_t pixel = edges.bits.index(lowest.column, rows.at(lowest.column, y));
      nearest.edge.at(x, y) = static_cast<EdgeId>(2 * pixel) + static_cast<EdgeId>(direction.bit);
    });
  });
}

}  // namespace

dvec3 position_of(EdgeId edge, const GBuffer& gbuffer) {
  const EdgePixels pixels = pixels_of(edge, gbuffer.width);
  return 0.5 * (dvec3(gbuffer.position[pixels.first]) + dvec3(gbuffer.position[pixels.second]));
}

bool is_one_surface(const GBuffer& gbuffer, std::size_t pixel, std::size_t neighbour) {
  if (!gbuffer.is_surface(pixel) || gbuffer.instance[pixel] != gbuffer.instance[neighbour]) return false;
  const dvec3 way = dvec3(gbuffer.position[neighbour]) - dvec3(gbuffer.position[pixel]);
  const double steepest = std::sqrt(0.5) * glm::length(way);
  return std::abs(glm::dot(dvec3(gbuffer.geometric_normal[pixel]), way)) <= steepest &&
         std::abs(glm::dot(dvec3(gbuffer.geometric_normal[neighbour]), way)) <= steepest;
}

ShadowEdges find_shadow_edges(const Image<float>& visibility, const GBuffer& gbuffer, const CountedPixels& counted) {
  assert(visibility.size() == gbuffer.instance.size() && visibility.size() == counted.exclusion.size());
  assert(visibility.size() < no_id / 2);
  const int width = visibility.width;
  const int height = visibility.height;
  ShadowEdges edges{Image<std::uint8_t>(width, height, 0), 0};
  const auto is_edge = [&](std::size_t a, std::size_t b) {
    return (visibility[a] >= 0.5f) != (visibility[b] >= 0.5f) && counted.exclusion[a] == PixelExclusion::none &&
           counted.exclusion[b] == PixelExclusion::none && is_one_surface(gbuffer, a, b);
  };
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const std::size_t i = visibility.index(x, y);
      std::uint8_t bits = 0;
      if (x + 1 < width && is_edge(i, i + 1)) bits |= 1;
      if (y + 1 < height && is_edge(i, i + static_cast<std::size_t>(width))) bits |= 2;
      edges.bits[i] = bits;
      edges.count += static_cast<std::uint64_t>((bits & 1) + (bits >> 1));
    }
  }
  return edges;
}

NearestEdges nearest_edges(const ShadowEdges& edges) {
  const int width = edges.bits.width;
  const int height = edges.bits.height;
  NearestEdges nearest{Image<float>(width, height, std::numeric_limits<float>::infinity()),
                       Image<EdgeId>(width, height, no_id)};
  if (edges.count == 0) return nearest;
  Image<std::int64_t> squares(width, height, std::numeric_limits<std::int64_t>::max());
  take_nearer(edges, {0, 1, 0}, squares, nearest);
  take_nearer(edges, {1, 0, 1}, squares, nearest);
  for (std::size_t i = 0; i < squares.size(); ++i) {
    nearest.distance[i] = static_cast<float>(0.5 * std::sqrt(static_cast<double>(squares[i])));
  }
  return nearest;
}

}  // namespace umbrameter
