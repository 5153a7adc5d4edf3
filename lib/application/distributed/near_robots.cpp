#include "distributed/near_robots.h"

#include <algorithm>
#include <numeric>

namespace robosim {
namespace {

/// Of the reach, the part by which robots may approach before the areas are renewed: a compromise between the cost of
/// renewing and that of more robots in larger areas.
constexpr double kMarginShare = 0.5;
constexpr double kStepsMax = 100;

std::uint64_t stepsFor(const Interaction& interaction) {
  const double approach_m = 2 * interaction.step_m;
  const double steps = approach_m > 0 ? kMarginShare * interaction.reach_m / approach_m : kStepsMax;
  return static_cast<std::uint64_t>(std::clamp(steps, 1.0, kStepsMax));
}

}  // namespace

NearRobots::NearRobots(const Bounds2D& surface, std::size_t robots, const Interaction& interaction)
    : steps_(stepsFor(interaction)),
      reach_m_(interaction.reach_m + 2 * interaction.step_m * static_cast<double>(steps_)),
      grid_(surface, robots, reach_m_),
      by_cell_(grid_) {}

std::string NearRobots::areaOf(std::span<const mrpt::math::TPose2D> poses, RobotRange work) const {
  std::string bytes;
  writeArea(grid_.around(poses, work, reach_m_), bytes);
  return bytes;
}

std::vector<std::vector<std::uint32_t>> NearRobots::neededBy(std::span<const mrpt::math::TPose2D> poses,
                                                             RobotRange robots, const std::vector<std::string>& areas,
                                                             const RankShares& shares, std::size_t own,
                                                             bool first_needs_all) {
  by_cell_.assign(poses, robots);
  std::vector<std::vector<std::uint32_t>> needed(shares.ranks());
  for (std::size_t rank = 0; rank < shares.ranks(); ++rank) {
    if (rank == own) continue;
    if (rank == 0 && first_needs_all) {
      needed[rank] = listOf(robots);
      continue;
    }
    needed[rank] = listOf(intersection(robots, shares.kept(rank)));
    by_cell_.addWithin(readArea(areas[rank], grid_.cells()), needed[rank]);
    std::sort(needed[rank].begin(), needed[rank].end());
    needed[rank].erase(std::unique(needed[rank].begin(), needed[rank].end()), needed[rank].end());
  }
  return needed;
}

std::vector<std::uint32_t> listOf(RobotRange robots) {
  std::vector<std::uint32_t> list(robots.empty() ? 0 : robots.end - robots.begin);
  std::iota(list.begin(), list.end(), static_cast<std::uint32_t>(robots.begin));
  return list;
}

}  // namespace robosim
