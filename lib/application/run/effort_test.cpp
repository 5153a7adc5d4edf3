#include "run/effort.h"

#include <gtest/gtest.h>

#include "run/local_run.h"

namespace robosim {
namespace {

/// A surface of 8 m × 2 m with two robots, 1 m apart, that drive along x; the first can send to the second.
LoadedWorld hallOfTwo() {
  const auto robot = [](const std::string& name, double y_m) {
    return "<object><shape><robot><cylinder><name>" + name + "</name><x>0.5</x><y>" + std::to_string(y_m) +
           "</y><z>0.1</z><radius>0.2</radius><height>0.2</height></cylinder></robot></shape></object>";
  };
  WorldSource source;
  source.file = "hall.xml";
  source.text = "<world><surface><size><xmin>0</xmin><xmax>8</xmax><ymin>0</ymin><ymax>2</ymax></size>" +
                robot("A", 0.5) + robot("B", 1.5) + "</surface></world>";
  return loadWorldToRun(source, "still");
}

class EffortOfAHall : public testing::Test {
 protected:
  EffortOfAHall() : environment_(world_.world, world_.fleet, {}) { effort_.observe(environment_); }
  /// Drives the first robot straight on at up to 1 m/s for ten steps of 0.1 s.
  void drive() {
    for (int i = 0; i < 10; ++i) {
      environment_.setCommand(0, {.speed_mps = 1, .turn_radps = 0});
      environment_.step();
      effort_.observe(environment_);
    }
  }
  double metric(const std::string& name) const {
    for (const auto& metric : effort_.metrics()) {
      if (metric.name == name) return metric.value;
    }
    throw std::logic_error(name);
  }

  LoadedWorld world_ = hallOfTwo();
  Environment environment_;
  Effort effort_{{.cell_m = 2, .standing_w = 36, .driving_j_per_m = 3600}};
};

TEST_F(EffortOfAHall, SpendsPowerForTimeAndEnergyForDistance) {
  EXPECT_EQ(metric("energy_wh"), 0);
  drive();
  const double driven_m = environment_.state().driven_m[0];
  EXPECT_GT(driven_m, 0.1);
  EXPECT_NEAR(metric("energy_wh"), 2 * 36 * 1.0 / 3600 + driven_m, 1e-12);
}

TEST_F(EffortOfAHall, CountsCellsThatSeveralRobotsVisit) {
  EXPECT_EQ(metric("visited_m2"), 4);  // both are in one cell of 2 m × 2 m
  EXPECT_EQ(metric("overlap"), 0.5);   // one of two visits
  while (environment_.state().world_from_robot[0].x < 2.1) drive();
  EXPECT_EQ(metric("visited_m2"), 8);
  EXPECT_NEAR(metric("overlap"), 1.0 / 3, 1e-15);
}

TEST_F(EffortOfAHall, CountsBytesOfDeliveredMessages) {
  environment_.send(0, "B", "hello");
  drive();
  EXPECT_EQ(metric("message_bytes"), 5);
}

}  // namespace
}  // namespace robosim
