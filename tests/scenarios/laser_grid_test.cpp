// Compares the exact laser with MRPT's simulation of a laser on an occupancy grid of the same scene.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>
#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/obs/CObservation2DRangeScan.h>

#include "base/random.h"
#include "sensors/laser.h"
#include "sensors/testing/single_robot_scene.h"

namespace robosim {
namespace {

constexpr float kCell_m = 0.05f;
constexpr double kHalf_m = 8;

/// Rasterises the scene to a grid of 5 cm cells: occupied where a cell's square touches a solid.
mrpt::maps::COccupancyGridMap2D gridOf(const std::vector<Solid>& solids) {
  mrpt::maps::COccupancyGridMap2D grid(-kHalf_m, kHalf_m, -kHalf_m, kHalf_m, kCell_m);
  for (int cy = 0; cy < static_cast<int>(grid.getSizeY()); ++cy) {
    for (int cx = 0; cx < static_cast<int>(grid.getSizeX()); ++cx) {
      const OrientedBox cell{{grid.idx2x(cx), grid.idx2y(cy)}, {1, 0}, kCell_m / 2, kCell_m / 2};
      const bool taken = std::any_of(solids.begin(), solids.end(),
                                     [&](const Solid& solid) { return distance(cell, solid.outline) == 0; });
      grid.setCell(cx, cy, taken ? 0.0f : 1.0f);
    }
  }
  return grid;
}

/// The scene with every solid grown by `by_m` (corners stay square, which is at least the exact growth).
std::vector<Solid> grown(std::vector<Solid> solids, double by_m) {
  for (auto& solid : solids) {
    if (auto* circle = std::get_if<Circle>(&solid.outline)) circle->radius_m += by_m;
    if (auto* box = std::get_if<OrientedBox>(&solid.outline)) {
      box->half_length_m += by_m;
      box->half_width_m += by_m;
    }
  }
  return solids;
}

TEST(LaserBesideMrptsGrid, DiffersByAtMostTheGridError) {
  std::vector<double> differences;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Rng rng(seed);
    std::vector<Solid> solids;
    while (solids.size() < 25) {
      const mrpt::math::TPoint2D at(rng.uniform(-7, 7), rng.uniform(-7, 7));
      if (at.norm() < 1.5) continue;  // position of the robot
      solids.push_back(rng.below(2) ? pillar(at.x, at.y, rng.uniform(0.1, 0.5))
                                    : block(at.x, at.y, rng.uniform(0.2, 1), rng.uniform(0.2, 1), rng.uniform(-3, 3)));
    }
    const auto grid = gridOf(solids);
    mrpt::obs::CObservation2DRangeScan scan;
    scan.aperture = static_cast<float>(M_PI);
    scan.maxRange = 10;  // MRPT's simulator uses 80 % of it
    scan.rightToLeft = true;
    const mrpt::math::TPose2D pose(rng.uniform(-0.3, 0.3), rng.uniform(-0.3, 0.3), rng.uniform(-3, 3));
    grid.laserScanSimulator(scan, mrpt::poses::CPose2D(pose), 0.5f, 181, 0);

    const auto laser = sensorFrom("<laser range_max_m='8'/>");
    const auto exact = SingleRobotScene(solids, pose).ranges(*laser);
    // An occupied cell extends at most by its diagonal beyond the solid. The simulator advances in steps of a cell and
    // may overshoot by a step.
    const double cell_diagonal_m = std::sqrt(2.0) * kCell_m;
    const auto earliest = SingleRobotScene(grown(solids, cell_diagonal_m), pose).ranges(*laser);
    for (std::size_t i = 0; i < 181; ++i) {
      if (!scan.getScanRangeValidity(i) || exact[i] >= 7.9) continue;
      const double on_grid = scan.getScanRange(i);
      EXPECT_GE(on_grid, earliest[i] - kCell_m) << "seed " << seed << " beam " << i;
      EXPECT_LE(on_grid, exact[i] + cell_diagonal_m) << "seed " << seed << " beam " << i;
      differences.push_back(std::abs(on_grid - exact[i]));
    }
  }
  ASSERT_GT(differences.size(), 500u);
  std::nth_element(differences.begin(), differences.begin() + static_cast<std::ptrdiff_t>(differences.size() / 2),
                   differences.end());
  const double median_m = differences[differences.size() / 2];
  std::printf("%zu beams, median difference %.4f m on cells of %.2f m\n", differences.size(), median_m, kCell_m);
  EXPECT_LT(median_m, kCell_m);
}

}  // namespace
}  // namespace robosim
