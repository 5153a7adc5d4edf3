#include "run/coverage.h"

#include <cmath>

#include <gtest/gtest.h>

#include "run/local_run.h"

namespace robosim {
namespace {

/// A surface of 4 m × 2 m, with a robot that starts in its lower left quarter and drives along x.
LoadedWorld hall() {
  WorldSource source;
  source.file = "hall.xml";
  source.text =
      "<world><surface><size><xmin>0</xmin><xmax>4</xmax><ymin>0</ymin><ymax>2</ymax></size>"
      "<object><shape><robot><cylinder><name>R</name><x>0.5</x><y>0.5</y><z>0.1</z><radius>0.2</radius>"
      "<height>0.2</height></cylinder></robot></shape></object></surface></world>";
  return loadWorldToRun(source, "still");
}

/// An environment whose robot drives straight on at 1 m/s.
class CoverageOfAHall : public testing::Test {
 protected:
  CoverageOfAHall() : environment_(world_.world, world_.fleet, {}) { coverage_.observe(environment_); }

  /// Drives until the robot is at x or, at the edge, for at most 20 s.
  void driveTo(double x_m) {
    for (int i = 0; i < 200 && environment_.state().world_from_robot[0].x < x_m; ++i) {
      environment_.setCommand(0, {.speed_mps = 1, .turn_radps = 0});
      environment_.step();
      coverage_.observe(environment_);
    }
  }
  double metric(std::size_t i) const { return coverage_.metrics()[i].value; }

  LoadedWorld world_ = hall();
  Environment environment_;
  Coverage coverage_{{.cell_m = 1, .end_percent = 25}};
};

TEST_F(CoverageOfAHall, CountsEachVisitedCellOnce) {
  EXPECT_EQ(metric(0), 12.5);  // one of eight cells
  driveTo(0.8);
  EXPECT_EQ(metric(0), 12.5);
  EXPECT_EQ(coverage_.endReason(), "");
  driveTo(1.2);
  EXPECT_EQ(metric(0), 25);
  EXPECT_EQ(coverage_.endReason(), "25.0 % covered");
}

TEST_F(CoverageOfAHall, HasNoTimeOfHalfTheCellsBeforeTheyAreVisited) {
  EXPECT_TRUE(std::isnan(metric(1)));
  driveTo(4);  // to the eastern edge, where it stalls: four of eight cells
  EXPECT_EQ(metric(0), 50);
  EXPECT_GT(metric(1), 2.4);  // 2.5 m at no more than 1 m/s
  EXPECT_LT(metric(1), 20);
}

}  // namespace
}  // namespace robosim
