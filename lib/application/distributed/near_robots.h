#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "distributed/area_grid.h"
#include "distributed/interaction.h"
#include "distributed/rank_shares.h"

namespace robosim {

/// Which robots a rank must know: those that it keeps, and those near the ones that it moves and senses (halo cells),
/// where near means so near that they may affect each other within steps() steps, however both drive. A rank describes
/// the surroundings of its robots as an Area, from which the others conclude which of theirs it must know.
class NearRobots {
 public:
  /// @param robots number of all
  NearRobots(const Bounds2D& surface, std::size_t robots, const Interaction& interaction);
  NearRobots(const NearRobots&) = delete;  // by_cell_ refers to grid_
  NearRobots& operator=(const NearRobots&) = delete;

  /// Number of steps after which the areas must be renewed.
  std::uint64_t steps() const { return steps_; }
  double reach() const { return reach_m_; }  ///< [m]; margins for the motion in steps() included

  /// Bytes of the area in which a rank must know all robots. @param poses of all robots @param work RankShares::work
  std::string areaOf(std::span<const mrpt::math::TPose2D> poses, RobotRange work) const;
  /// The robots of a range that each rank must know, in ascending order; none for the rank `own`.
  /// @param robots whose poses are valid @param areas by rank: bytes of areaOf()
  /// @param first_needs_all whether rank 0 must know all
  std::vector<std::vector<std::uint32_t>> neededBy(std::span<const mrpt::math::TPose2D> poses, RobotRange robots,
                                                   const std::vector<std::string>& areas, const RankShares& shares,
                                                   std::size_t own, bool first_needs_all);

 private:
  std::uint64_t steps_;
  double reach_m_;
  AreaGrid grid_;
  RobotsByCell by_cell_;
};

/// The robots of a range, one by one.
std::vector<std::uint32_t> listOf(RobotRange robots);

}  // namespace robosim
