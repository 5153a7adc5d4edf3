#include "world/generation/places.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <utility>

#include "base/error_list.h"

namespace robosim {
namespace {

constexpr double kMaxPoints = 2e7;
constexpr std::uint32_t kUnknown = std::numeric_limits<std::uint32_t>::max();

/// A grid of points in the bounds, of which some are blocked.
class PointGrid {
 public:
  PointGrid(const Bounds2D& bounds, double pitch_m, double clearance_m)
      : bounds_(bounds),
        pitch_m_(pitch_m),
        columns_(countIn(bounds.x_max - bounds.x_min - 2 * clearance_m)),
        rows_(countIn(bounds.y_max - bounds.y_min - 2 * clearance_m)) {
    if (static_cast<double>(columns_) * static_cast<double>(rows_) > kMaxPoints) {
      throw ConfigError("the world has more than 20,000,000 places; make it smaller");
    }
    free_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), 1);
  }

  void block(const Outline& outline, double clearance_m) {
    const Bounds2D b = boundsOf(outline);
    const auto [first_column, last_column] = span(b.x_min - clearance_m - x(0), b.x_max + clearance_m - x(0), columns_);
    const auto [first_row, last_row] = span(b.y_min - clearance_m - y(0), b.y_max + clearance_m - y(0), rows_);
    for (std::int64_t row = first_row; row <= last_row; ++row) {
      for (std::int64_t column = first_column; column <= last_column; ++column) {
        if (distance(outline, {x(column), y(row)}) < clearance_m) free_[index(column, row)] = 0;
      }
    }
  }

  Places largestRegion() const {
    std::vector<std::uint32_t> region(free_.size(), kUnknown);
    std::vector<std::size_t> sizes;
    for (std::size_t i = 0; i < free_.size(); ++i) {
      if (free_[i] && region[i] == kUnknown) sizes.push_back(fill(i, static_cast<std::uint32_t>(sizes.size()), region));
    }
    Places places;
    if (sizes.empty()) return places;
    const auto largest = static_cast<std::uint32_t>(std::max_element(sizes.begin(), sizes.end()) - sizes.begin());
    std::vector<std::uint32_t> number(free_.size(), kUnknown);
    for (std::size_t i = 0; i < free_.size(); ++i) {
      if (region[i] != largest) continue;
      number[i] = static_cast<std::uint32_t>(places.at.size());
      places.at.emplace_back(x(column(i)), y(row(i)));
    }
    places.next.resize(places.at.size());
    for (std::size_t i = 0; i < free_.size(); ++i) {
      if (number[i] == kUnknown) continue;
      forNeighbours(i, [&](std::size_t near) {
        if (number[near] != kUnknown) places.next[number[i]].push_back(number[near]);
      });
    }
    return places;
  }

 private:
  std::int64_t countIn(double length_m) const {
    return length_m < 0 ? 0 : static_cast<std::int64_t>(length_m / pitch_m_) + 1;
  }
  /// The grid is centred in the bounds.
  double x(std::int64_t column) const {
    return (bounds_.x_min + bounds_.x_max) / 2 +
           (static_cast<double>(column) - static_cast<double>(columns_ - 1) / 2) * pitch_m_;
  }
  double y(std::int64_t row) const {
    return (bounds_.y_min + bounds_.y_max) / 2 +
           (static_cast<double>(row) - static_cast<double>(rows_ - 1) / 2) * pitch_m_;
  }
  std::size_t index(std::int64_t column, std::int64_t row) const {
    return static_cast<std::size_t>(row * columns_ + column);
  }
  std::int64_t column(std::size_t i) const { return static_cast<std::int64_t>(i) % columns_; }
  std::int64_t row(std::size_t i) const { return static_cast<std::int64_t>(i) / columns_; }
  /// First and last of `count` points that lie between two offsets from the first point.
  std::pair<std::int64_t, std::int64_t> span(double from_m, double to_m, std::int64_t count) const {
    const auto first = static_cast<std::int64_t>(std::ceil(std::max(0.0, from_m / pitch_m_)));
    const auto last = static_cast<std::int64_t>(std::floor(std::min(static_cast<double>(count - 1), to_m / pitch_m_)));
    return {first, last};
  }
  template <typename Do>
  void forNeighbours(std::size_t i, const Do& act) const {
    if (column(i) > 0) act(i - 1);
    if (column(i) + 1 < columns_) act(i + 1);
    if (row(i) > 0) act(i - static_cast<std::size_t>(columns_));
    if (row(i) + 1 < rows_) act(i + static_cast<std::size_t>(columns_));
  }
  /// Flood fill. @return number of points
  std::size_t fill(std::size_t start, std::uint32_t number, std::vector<std::uint32_t>& region) const {
    std::vector<std::size_t> open{start};
    region[start] = number;
    std::size_t count = 0;
    while (!open.empty()) {
      const std::size_t i = open.back();
      open.pop_back();
      ++count;
      forNeighbours(i, [&](std::size_t near) {
        if (!free_[near] || region[near] != kUnknown) return;
        region[near] = number;
        open.push_back(near);
      });
    }
    return count;
  }

  Bounds2D bounds_;
  double pitch_m_;
  std::int64_t columns_, rows_;
  std::vector<std::uint8_t> free_;
};

}  // namespace

Places placesAmong(const std::vector<WorldObject>& objects, const Bounds2D& bounds, double pitch_m,
                   double clearance_m) {
  PointGrid grid(bounds, pitch_m, clearance_m);
  for (const auto& object : objects) grid.block(object.body.solid().outline, clearance_m);
  return grid.largestRegion();
}

StepsFromSources::StepsFromSources(const Places& places) : places_(places), steps_(places.at.size(), kUnknown) {}

void StepsFromSources::addSource(std::uint32_t place) {
  std::deque<std::uint32_t> open{place};
  steps_[place] = 0;
  while (!open.empty()) {
    const std::uint32_t here = open.front();
    open.pop_front();
    for (const std::uint32_t near : places_.next[here]) {
      if (steps_[near] <= steps_[here] + 1) continue;
      steps_[near] = steps_[here] + 1;
      open.push_back(near);
    }
  }
}

}  // namespace robosim
