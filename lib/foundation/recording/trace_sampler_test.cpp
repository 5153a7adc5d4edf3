#include "recording/trace_sampler.h"

#include <cmath>

#include <gtest/gtest.h>

namespace robosim {
namespace {

using mrpt::math::TPose2D;

/// Drives one robot, with the name "a"; "b" stands at the origin.
class TraceSamplerTest : public testing::Test {
 protected:
  TraceSamplerTest() {
    sampler_.addRobot("a");
    sampler_.addRobot("b");
  }
  void step(const TPose2D& pose) { sampler_.add(step_++, readings_, {pose, TPose2D()}, commands_, points_); }
  /// Points of the robot "a".
  std::vector<TracePoint> ofFirst() const {
    std::vector<TracePoint> some;
    for (const auto& point : points_) {
      if (point.robot == 0) some.push_back(point);
    }
    return some;
  }

  TraceSampler sampler_;
  std::uint32_t step_ = 0;
  std::vector<Readings> readings_{2};
  std::vector<Command> commands_;
  std::vector<TracePoint> points_;
};

TEST_F(TraceSamplerTest, HasAPointEachQuarterMetreOfAStraightWay) {
  for (int i = 0; i <= 40; ++i) step({0.03125 * i, 0, 0});  // 8 steps are 0.25 m
  ASSERT_EQ(points_.size(), 1U + 6) << "b does not move";
  for (std::size_t i = 0; i < 6; ++i)
    EXPECT_EQ(ofFirst()[i], (TracePoint{8 * static_cast<std::uint32_t>(i), 0, 0.25F * static_cast<float>(i), 0, 0}));
}

TEST_F(TraceSamplerTest, HasNoPointsOfARobotThatTurnsOnTheSpotAndOneWhereItDrivesOn) {
  step({0, 0, 0});
  for (int i = 1; i <= 10; ++i) step({0, 0, 0.3 * i});
  EXPECT_EQ(ofFirst().size(), 1U);
  step({0, 0.02, 3});
  EXPECT_EQ(ofFirst().size(), 2U);
}

// The robot drives circles of a radius of 0.5 m: the chord of 0.1 rad, or the step after it, deviates by at most
// 0.5 m * (1 - cos(0.06 rad)) = 0.9 mm.
TEST_F(TraceSamplerTest, StaysNearTheWay) {
  for (int i = 0; i < 1000; ++i) {
    const double angle = 0.02 * i;
    step({0.5 * std::cos(angle), 0.5 * std::sin(angle), angle + M_PI / 2});
  }
  const auto points = ofFirst();
  for (std::size_t i = 1; i < points.size(); ++i) {
    const double middle_m = std::hypot(points[i].x_m + points[i - 1].x_m, points[i].y_m + points[i - 1].y_m) / 2;
    EXPECT_NEAR(middle_m, 0.5, 1e-3);
  }
  EXPECT_LT(points.size(), 220U);
}

TEST_F(TraceSamplerTest, HasAPointWhereARobotDisappearsAndAppears) {
  commands_.resize(2);
  step({1, 2, 0});
  commands_[0].activity = Activity::absent;
  step({1, 2, 0});
  step({5, 5, 0});
  commands_[0].activity = Activity::active;
  step({1, 2, 0});
  EXPECT_EQ(ofFirst(), (std::vector<TracePoint>{{0, 0, 1, 2, 0}, {1, 0, 0, 0, TracePoint::absent}, {3, 0, 1, 2, 0}}));
}

TEST_F(TraceSamplerTest, HasAPointWhereARobotStallsFindsGoldOrSendsAMessage) {
  commands_.resize(2);
  step({1, 2, 0});
  readings_[0].stalled = true;
  step({1, 2, 0});
  step({1, 2, 0});
  readings_[0].stalled = false;
  step({1, 2, 0});
  commands_[0].activity = Activity::found;
  step({1, 2, 0});
  readings_[1].inbox.edit() = {{"a", "b", "GOLD"}, {"c", "b", "of another"}};
  step({1, 2, 0});
  step({1, 2, 0});
  readings_[1].inbox.clear();
  step({1, 2, 0});
  using P = TracePoint;
  EXPECT_EQ(ofFirst(), (std::vector<TracePoint>{{0, 0, 1, 2, 0},
                                                {1, 0, 1, 2, P::stalled},
                                                {3, 0, 1, 2, 0},
                                                {4, 0, 1, 2, P::found},
                                                {5, 0, 1, 2, P::found | P::sent},
                                                {6, 0, 1, 2, P::found | P::sent}}));
}

}  // namespace
}  // namespace robosim
