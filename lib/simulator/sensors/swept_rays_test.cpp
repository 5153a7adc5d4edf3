#include "sensors/swept_rays.h"

#include <array>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include "base/random.h"
#include "base/testing/vector_widths.h"
#include "sensors/swept_pose.h"

namespace robosim {
namespace {

Ray randomRay(Rng& rng) {
  return {{rng.uniform(-1, 1), rng.uniform(-1, 1), 0.25}, {rng.uniform(-1, 1), rng.uniform(-1, 1), 0}};
}

TEST(SweptRays, AreEqualToEachRayMovedToItsOwnPose) {
  for (std::uint64_t seed = 1; seed <= 500; ++seed) {
    Rng rng(seed);
    std::vector<Ray> beams(1 + rng.below(40));
    for (Ray& beam : beams) beam = randomRay(rng);
    const PlanarTransform now({rng.uniform(-9, 9), rng.uniform(-9, 9), rng.uniform(-3, 3)}, 0.5);
    const Motion motion{.length_m = rng.uniform(-1, 1),
                        .turn_rad = rng.below(4) > 0 ? rng.uniform(-2, 2) : 0,
                        .lateral_m = rng.below(2) > 0 ? rng.uniform(-1, 1) : 0};
    const double pan_rad = rng.below(2) > 0 ? rng.uniform(-3, 3) : 0;
    const std::array<double, 2> first_shares{rng.uniform(0.5, 1.5), rng.uniform(0, 0.5)};
    const std::size_t revolutions = 1 + rng.below(2);
    const double step_share = rng.uniform(0, 0.02);

    // One ray after the other.
    std::vector<Ray> expected(beams.size());
    const PlanarTransform pan(PlanarTransform(), pan_rad);
    for (std::size_t revolution = 0; revolution < revolutions; ++revolution) {
      SweptPoseAside pose(now, motion, first_shares[revolution], step_share);
      for (std::size_t i = 0; i < beams.size(); ++i, pose.next()) {
        if (i % revolutions != revolution) continue;
        expected[i] = {pose.pointToWorld(beams[i].origin), pose.turnToWorld(pan.turnToWorld(beams[i].direction))};
      }
    }
    const SweptRays rays(beams);
    forEachVectorWidth([&](VectorWidth width) {
      std::vector<Ray> swept;
      rays.place(now, motion, pan_rad, std::span(first_shares).first(revolutions), step_share, swept);
      ASSERT_GE(swept.size(), beams.size());
      for (std::size_t i = 0; i < beams.size(); ++i) {
        ASSERT_EQ(swept[i].origin, expected[i].origin) << "seed " << seed << " ray " << i << nameOf(width);
        ASSERT_EQ(swept[i].direction, expected[i].direction) << "seed " << seed << " ray " << i << nameOf(width);
      }
    });
  }
}

}  // namespace
}  // namespace robosim
