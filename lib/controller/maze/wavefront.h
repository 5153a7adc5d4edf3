#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "maze/maze_map.h"

namespace robosim {

/// Shortest paths over a MazeMap from one cell: Dijkstra's algorithm with a ring of buckets, since step costs are small
/// integers (Dial, "Algorithm 360", CACM 12, 1969). Blocked cells are impassable except near the start, so that a robot
/// close to a wall can leave it. Cells close to walls cost more, so that paths keep a clearance.
class Wavefront {
 public:
  static constexpr int kStraight = 2, kDiagonal = 3;  ///< cost of a step to a neighbour
  static constexpr int kCrowded = 3;                  ///< additional cost close to walls
  static constexpr int kTight = 8;                    ///< additional cost of blocked cells near the start

  /// Expands from `start` until the goal with the least path cost + judge(cell) is known, or up to `cost_max`.
  /// @param judge additional cost (>= 0) of a goal cell; negative for other cells.
  template <typename Judge>
  std::optional<Cell> findGoal(const MazeMap& map, const Cell& start, int cost_max, const Judge& judge);

  /// Path to a cell reached by the last search: from the cell after the start to `goal`, both included.
  void pathTo(const MazeMap& map, const Cell& goal, std::vector<Cell>& path) const;

 private:
  struct Node {
    std::uint32_t search = 0;  ///< number of the search that set `cost`
    std::int32_t cost = 0;
    std::uint8_t from = 0;  ///< index in kNeighbours of the step that led here
    bool done = false;
  };
  struct Neighbour {
    Cell offset;
    int cost;
  };
  static constexpr std::array<Neighbour, 8> kNeighbours{{{{1, 0}, kStraight},
                                                         {{0, 1}, kStraight},
                                                         {{0, -1}, kStraight},
                                                         {{-1, 0}, kStraight},
                                                         {{1, 1}, kDiagonal},
                                                         {{1, -1}, kDiagonal},
                                                         {{-1, 1}, kDiagonal},
                                                         {{-1, -1}, kDiagonal}}};
  static constexpr int kStartReach = 2;  ///< radius around the start in which cells may be blocked
  static constexpr std::size_t kBuckets = 16;
  static_assert(kDiagonal + kCrowded + kTight < static_cast<int>(kBuckets));

  void begin(const MazeMap& map, const Cell& start);
  void spread(const MazeMap& map, const Cell& from, int cost);

  Cell start_;
  std::uint32_t search_ = 0;
  std::vector<Node> nodes_;
  std::array<std::vector<Cell>, kBuckets> buckets_;
  std::size_t waiting_ = 0;
};

template <typename Judge>
std::optional<Cell> Wavefront::findGoal(const MazeMap& map, const Cell& start, int cost_max, const Judge& judge) {
  begin(map, start);
  std::optional<Cell> best;
  int best_cost = cost_max;
  for (int cost = 0; cost < best_cost && waiting_ > 0; ++cost) {
    auto& bucket = buckets_[static_cast<std::size_t>(cost) % kBuckets];
    for (std::size_t i = 0; i < bucket.size(); ++i) {
      const Cell cell = bucket[i];
      --waiting_;
      Node& node = nodes_[map.index(cell)];
      if (node.done) continue;
      node.done = true;
      const int extra = judge(cell);
      if (extra >= 0 && cost + extra < best_cost) {
        best = cell;
        best_cost = cost + extra;
        if (extra == 0) return best;
      }
      spread(map, cell, cost);
    }
    bucket.clear();
  }
  return best;
}

}  // namespace robosim
