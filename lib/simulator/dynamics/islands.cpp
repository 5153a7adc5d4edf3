#include "dynamics/islands.h"

#include <limits>

#include "dynamics/sets.h"

namespace robosim {
namespace {

using With = PushingGroup::Pair::With;

/// Bodies of a group as nodes: objects, then robots.
class IslandSearch {
 public:
  IslandSearch(const PushingGroup& group, const GroupMoment& from, const std::vector<mrpt::math::TPoint2D>& robots_to,
               double duration_s)
      : group_(group),
        objects_(group.objects.size()),
        reach_m_(islandReach(group, duration_s)),
        sets_(objects_ + group.robots.size()),
        is_moving_(objects_ + group.robots.size()) {
    for (std::size_t i = 0; i < objects_; ++i) {
      const ObjectMotion& motion = from.objects[i];
      const auto floor_mps = floorVelocityUnder(group, motion);
      is_moving_[i] = motion.isAtRest() && floor_mps.x == 0 && floor_mps.y == 0 ? 0 : 1;
    }
    for (std::size_t r = 0; r < group.robots.size(); ++r) {
      is_moving_[objects_ + r] = from.robots[r] == robots_to[r] ? 0 : 1;
    }
    findNearPairs(from);
    spread();
  }

  std::vector<Island> islands() {
    constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
    std::vector<Island> islands;
    std::vector<std::size_t> island_of(is_moving_.size(), kNone);
    const auto island = [&](std::size_t node) -> Island& {
      std::size_t& found = island_of[sets_.of(node)];
      if (found == kNone) {
        found = islands.size();
        islands.emplace_back();
      }
      return islands[found];
    };
    for (std::size_t node = 0; node < is_moving_.size(); ++node) {
      if (!is_moving_[node] && !isWithMoving(node)) continue;
      if (node < objects_) {
        island(node).objects.push_back(static_cast<std::uint32_t>(node));
      } else {
        island(node).robots.push_back(static_cast<std::uint32_t>(node - objects_));
      }
    }
    for (const auto p : near_) {
      const std::size_t node = firstOf(group_.pairs[p]);
      if (is_moving_[node] || isWithMoving(node)) island(node).pairs.push_back(p);
    }
    std::erase_if(islands, [](const Island& of) { return of.objects.empty() && of.pairs.empty(); });
    return islands;
  }

 private:
  std::size_t firstOf(const PushingGroup::Pair& pair) const {
    return pair.with == With::two_robots ? objects_ + pair.first : pair.first;
  }
  /// Node of the second body; that of the first for a stationary one.
  std::size_t secondOf(const PushingGroup::Pair& pair) const {
    switch (pair.with) {
      case With::object:
        return pair.second;
      case With::stationary:
        return pair.first;
      default:
        return objects_ + pair.second;
    }
  }

  /// Both bodies of a pair may move by the reach.
  void findNearPairs(const GroupMoment& from) {
    for (std::size_t r = 0; r < group_.robots.size(); ++r) {
      if (const auto partner = group_.robots[r].partner) sets_.join(objects_ + r, objects_ + *partner);
    }
    for (std::uint32_t p = 0; p < group_.pairs.size(); ++p) {
      const auto& pair = group_.pairs[p];
      if (!mayTouch(group_, from, pair, 2 * reach_m_)) continue;
      near_.push_back(p);
      sets_.join(firstOf(pair), secondOf(pair));
    }
  }

  /// Marks the sets in which anything moves.
  void spread() {
    moves_.assign(is_moving_.size(), 0);
    for (std::size_t node = 0; node < is_moving_.size(); ++node) {
      if (is_moving_[node]) moves_[sets_.of(node)] = 1;
    }
  }
  bool isWithMoving(std::size_t node) { return moves_[sets_.of(node)] != 0; }

  const PushingGroup& group_;
  std::size_t objects_;
  double reach_m_;
  Sets sets_;
  std::vector<std::uint8_t> is_moving_, moves_;
  std::vector<std::uint32_t> near_;
};

}  // namespace

double islandReach(const PushingGroup& group, double duration_s) {
  return group.speed_max_mps * duration_s + 10 * kContactGap_m;
}

std::vector<Island> islandsOf(const PushingGroup& group, const GroupMoment& from,
                              const std::vector<mrpt::math::TPoint2D>& robots_to, double duration_s) {
  return IslandSearch(group, from, robots_to, duration_s).islands();
}

}  // namespace robosim
