#include "compare/components.h"

#include <cassert>
#include <limits>

namespace umbrameter {
namespace {

constexpr std::uint32_t unlabelled = std::numeric_limits<std::uint32_t>::max();

// Disjoint sets of labels; the root of a set is its first label.
class LabelSets {
 public:
  std::uint32_t add() {
    parent_.push_back(static_cast<std::uint32_t>(parent_.size()));
    return parent_.back();
  }
  std::uint32_t root(std::uint32_t label) {
    while (parent_[label] != label) {
      parent_[label] = parent_[parent_[label]];
      label = parent_[label];
    }
    return label;
  }
  std::uint32_t join(std::uint32_t a, std::uint32_t b) {
    a = root(a);
    b = root(b);
    if (a < b) return parent_[b] = a;
    return parent_[a] = b;
  }
  std::size_t size() const { return parent_.size(); }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace

std::vector<Component> find_components(const Image<std::uint8_t>& marks, const Image<std::uint32_t>& weights) {
  assert(marks.size() == weights.size());
  Image<std::uint32_t> labels(marks.width, marks.height, unlabelled);
  LabelSets sets;
  for (int y = 0; y < marks.height; ++y) {
    for (int x = 0; x < marks.width; ++x) {
      const std::uint8_t mark = marks.at(x, y);
      if (mark == 0) continue;
      std::uint32_t label = unlabelled;
      const auto take = [&](int nx, int ny) {
        if (nx < 0 || nx >= marks.width || ny < 0 || marks.at(nx, ny) != mark) return;
        const std::uint32_t other = labels.at(nx, ny);
        label = label == unlabelled ? other : sets.join(label, other);
      };
      take(x - 1, y - 1);
      take(x, y - 1);
      take(x + 1, y - 1);
      take(x - 1, y);
      labels.at(x, y) = label == unlabelled ? sets.add() : label;
    }
  }
  std::vector<std::uint32_t> place(sets.size(), unlabelled);
  std::vector<Component> components;
  for (int y = 0; y < marks.height; ++y) {
    for (int x = 0; x < marks.width; ++x) {
      const std::size_t i = marks.index(x, y);
      if (marks[i] == 0) continue;
      std::uint32_t& slot = place[sets.root(labels[i])];
      if (slot == unlabelled) {
        slot = static_cast<std::uint32_t>(components.size());
        components.push_back({marks[i], 0, 0.0, 0.0, 0.0});
      }
      Component& component = components[slot];
      ++component.pixels;
      component.weight += weights[i];
      component.center_x += x;
      component.center_y += y;
    }
  }
  for (Component& component : components) {
    component.center_x /= static_cast<double>(component.pixels);
    component.center_y /= static_cast<double>(component.pixels);
  }
  return components;
}

ComponentStatistics summarize(const std::vector<Component>& components, std::uint8_t mark) {
  ComponentStatistics statistics;
  std::uint64_t pixels = 0;
  double weight = 0.0;
  const Component* largest = nullptr;
  for (const Component& component : components) {
    if (component.mark != mark) continue;
    ++statistics.count;
    pixels += component.pixels;
    weight += component.weight;
    if (largest == nullptr || component.pixels > largest->pixels) largest = &component;
  }
  if (largest == nullptr) return statistics;
  statistics.mean_area = static_cast<double>(pixels) / static_cast<double>(statistics.count);
  statistics.largest_area = largest->pixels;
  statistics.largest_share = weight > 0.0 ? largest->weight / weight : 0.0;
  statistics.largest_x = largest->center_x;
  statistics.largest_y = largest->center_y;
  return statistics;
}

}  // namespace umbrameter
