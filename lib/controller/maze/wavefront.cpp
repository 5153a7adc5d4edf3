#include "maze/wavefront.h"

#include <algorithm>

namespace robosim {

void Wavefront::begin(const MazeMap& map, const Cell& start) {
  if (nodes_.size() != map.size()) nodes_.assign(map.size(), {});
  ++search_;
  for (auto& bucket : buckets_) bucket.clear();
  start_ = start;
  waiting_ = 0;
  if (!map.contains(start)) return;
  nodes_[map.index(start)] = {.search = search_, .cost = 0, .from = 0, .done = false};
  buckets_[0].push_back(start);
  waiting_ = 1;
}

void Wavefront::spread(const MazeMap& map, const Cell& from, int cost) {
  for (std::size_t i = 0; i < kNeighbours.size(); ++i) {
    const Cell cell{from.x + kNeighbours[i].offset.x, from.y + kNeighbours[i].offset.y};
    if (!map.contains(cell)) continue;
    const std::size_t index = map.index(cell);
    const MapCell& there = map.at(index);
    int total = cost + kNeighbours[i].cost;
    if (there.blocked()) {
      if (ringDistance(cell, start_) > kStartReach || there.evidence > 0) continue;
      total += kTight;
    } else if (there.walls_close > 0) {
      total += kCrowded;
    }
    Node& node = nodes_[index];
    if (node.search == search_ && node.cost <= total) continue;
    node = {.search = search_, .cost = total, .from = static_cast<std::uint8_t>(i), .done = false};
    buckets_[static_cast<std::size_t>(total) % kBuckets].push_back(cell);
    ++waiting_;
  }
}

void Wavefront::pathTo(const MazeMap& map, const Cell& goal, std::vector<Cell>& path) const {
  path.clear();
  for (Cell cell = goal; cell != start_;) {
    path.push_back(cell);
    const Cell& step = kNeighbours[nodes_[map.index(cell)].from].offset;
    cell = {cell.x - step.x, cell.y - step.y};
  }
  std::reverse(path.begin(), path.end());
}

}  // namespace robosim
