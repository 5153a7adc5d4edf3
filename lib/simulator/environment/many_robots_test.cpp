#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "base/random.h"
#include "environment/environment.h"
#include "environment/testing/small_world.h"

namespace robosim {
namespace {

constexpr int kRobots = 1000;

/// A thousand robots of different sizes among walls and pillars, two fifths of the ground covered.
void addManyRobots(World& world, Fleet& fleet, std::uint64_t seed) {
  world = emptyWorld(18);
  Rng rng(seed);
  for (const double side : {-1.0, 1.0}) {
    addWall(world, 18.5 * side, 0, 1, 38);
    addWall(world, 0, 18.5 * side, 38, 1);
  }
  for (int i = 0; i < 25; ++i) {
    addWall(world, rng.uniform(-16, 16), rng.uniform(-16, 16), rng.uniform(0.05, 3), rng.uniform(0.05, 0.5),
            rng.uniform(-M_PI, M_PI));
    auto& pillar = world.objects.emplace_back(world.objects.back());
    pillar.body.shape = Cylinder{rng.uniform(0.05, 0.6)};
    pillar.body.world_from_body = {rng.uniform(-16, 16), rng.uniform(-16, 16), 0};
  }
  std::vector<Circle> taken;
  while (fleet.robots.size() < kRobots) {
    const Circle disc{{rng.uniform(-17.5, 17.5), rng.uniform(-17.5, 17.5)}, rng.uniform(0.15, 0.4)};
    bool clear = true;
    for (const auto& other : taken) clear = clear && distance(disc, other) > 0;
    for (const auto& object : world.objects) clear = clear && distance(object.body.solid().outline, disc) > 0;
    if (!clear) continue;
    taken.push_back(disc);
    addDisc(world, fleet, "r" + std::to_string(taken.size()), {disc.center.x, disc.center.y, rng.uniform(-M_PI, M_PI)},
            disc.radius_m, {1.5, 5, 3, 3, 20});
  }
}

/// Tests every pair of bodies for an overlap.
class BruteForce {
 public:
  explicit BruteForce(const Environment& environment) : environment_(environment) {
    for (const auto& robot : environment.fleet().robots) radii_m_.push_back(robot.info.radius_m);
    for (const auto& object : environment.world().objects) outlines_.push_back(object.body.solid().outline);
  }

  /// The first overlap; empty if there is none.
  std::string overlap() const {
    const auto& poses = environment_.state().world_from_robot;
    for (std::size_t i = 0; i < poses.size(); ++i) {
      int overlaps = 0;
      for (std::size_t j = 0; j < i; ++j) {
        const double dx = poses[i].x - poses[j].x;
        const double dy = poses[i].y - poses[j].y;
        const double reach_m = radii_m_[i] + radii_m_[j];
        overlaps += dx * dx + dy * dy < reach_m * reach_m ? 1 : 0;
      }
      if (overlaps > 0) return "robot " + std::to_string(i) + " in another";
      for (const auto& outline : outlines_) {
        const bool apart = distance(outline, mrpt::math::TPoint2D(poses[i].x, poses[i].y)) >= radii_m_[i];
        if (!apart) return "robot " + std::to_string(i) + " in an object";
      }
    }
    return "";
  }

 private:
  const Environment& environment_;
  std::vector<double> radii_m_;
  std::vector<Outline> outlines_;
};

TEST(ManyRobots, AThousandRobotsNeverOverlapInTwoThousandSteps) {
  World world;
  Fleet fleet;
  addManyRobots(world, fleet, 7);
  Environment environment(world, fleet, {.seed = 1, .period_s = 0.1, .threads = 2});
  const BruteForce checker(environment);
  ASSERT_EQ(checker.overlap(), "");
  for (int step = 0; step < 2000; ++step) {
    for (std::uint32_t i = 0; i < kRobots; ++i) {
      // Each keeps a course for a while, mostly forwards, then takes another.
      Rng rng(3, RandomPurpose::test, i, 0, static_cast<std::uint64_t>(step / 15));
      environment.setCommand(i, {.speed_mps = rng.uniform(-0.5, 2), .turn_radps = rng.uniform(-4, 4)});
    }
    environment.step();
    ASSERT_EQ(checker.overlap(), "") << "after step " << step + 1;
  }
  double driven_m = 0;
  for (const double way_m : environment.state().driven_m) driven_m += way_m;
  EXPECT_GT(driven_m / kRobots, 10) << "otherwise the robots are stuck";
  EXPECT_GT(environment.state().stalls, 100000u) << "otherwise the robots rarely touch";
}

TEST(ManyRobots, IsIndependentOfTheNumberOfThreads) {
  const auto digest = [](int threads) {
    World world;
    Fleet fleet;
    addManyRobots(world, fleet, 8);
    Environment environment(world, fleet, {.seed = 1, .period_s = 0.1, .threads = threads});
    for (int step = 0; step < 100; ++step) {
      for (std::uint32_t i = 0; i < kRobots; ++i) {
        Rng rng(4, RandomPurpose::test, i, 0, static_cast<std::uint64_t>(step / 15));
        environment.setCommand(i, {.speed_mps = rng.uniform(-0.5, 2), .turn_radps = rng.uniform(-4, 4)});
      }
      environment.step();
    }
    return environment.digest();
  };
  const std::string alone = digest(1);
  EXPECT_EQ(digest(2), alone);
  EXPECT_EQ(digest(4), alone);
}

TEST(ManyRobots, EveryRobotOfALargeSwarmReceivesTheBroadcastsOfItsNeighbours) {
  // A lattice of 40 × 50 robots, 1 m apart, with a range of 1 m: each receives those of its two to four neighbours.
  constexpr int kColumns = 40, kRows = 50;
  World world = emptyWorld(30);
  world.communication.range_m = 1.0;
  Fleet fleet;
  for (int i = 0; i < kColumns * kRows; ++i) {
    addDisc(world, fleet, "r" + std::to_string(i), {i % kColumns - 20.0, i / kColumns - 25.0, 0});
  }
  std::string digest;
  for (const int threads : {1, 3}) {
    Environment environment(world, fleet, {.threads = threads});
    for (int step = 0; step < 3; ++step) {
      for (std::size_t i = 0; i < environment.robotCount(); ++i) environment.broadcast(i, "from " + std::to_string(i));
      environment.step();
    }
    for (int i = 0; i < kColumns * kRows; ++i) {
      std::vector<std::string> expected;
      if (i >= kColumns) expected.push_back("from " + std::to_string(i - kColumns));
      if (i % kColumns > 0) expected.push_back("from " + std::to_string(i - 1));
      if (i % kColumns + 1 < kColumns) expected.push_back("from " + std::to_string(i + 1));
      if (i + kColumns < kColumns * kRows) expected.push_back("from " + std::to_string(i + kColumns));
      std::vector<std::string> received;
      for (const auto& message : environment.state().readings[static_cast<std::size_t>(i)].inbox)
        received.push_back(message.text);
      ASSERT_EQ(received, expected) << "robot " << i;
    }
    // 39 · 50 horizontal and 40 · 49 vertical pairs, both ways.
    EXPECT_EQ(environment.state().messages_delivered, 3u * 2 * (39 * 50 + 40 * 49));
    EXPECT_EQ(environment.state().messages_dropped, 0u);
    EXPECT_EQ(messagesSent(environment.state()), 3u * 2000 * 1999);
    if (digest.empty()) digest = environment.digest();
    EXPECT_EQ(environment.digest(), digest) << "on " << threads << " threads";
  }
}

}  // namespace
}  // namespace robosim
