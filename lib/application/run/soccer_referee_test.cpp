#include "run/soccer_referee.h"

#include <gtest/gtest.h>

#include "run/local_run.h"

namespace robosim {
namespace {

/// A pitch from -4 m to 4 m with a ball and a robot.
LoadedWorld pitch(const std::string& ball = "Ball") {
  WorldSource source;
  source.file = "pitch.xml";
  source.text =
      "<world><surface><size><xmin>-5</xmin><xmax>5</xmax><ymin>-2</ymin><ymax>2</ymax></size>"
      "<object><shape><primitive><cylinder><name>" +
      ball +
      "</name><x>0</x><y>0</y><z>0.1</z><radius>0.1</radius><height>0.2</height><movable/></cylinder></primitive>"
      "</shape></object><object><shape><robot><cylinder><name>R</name><x>-1</x><y>0</y><z>0.1</z><radius>0.2</radius>"
      "<height>0.2</height></cylinder></robot></shape></object></surface></world>";
  return loadWorldToRun(source, "still");
}

class RefereeOnAPitch : public testing::Test {
 protected:
  RefereeOnAPitch() : environment_(world_.world, world_.fleet, {}) {}
  void place(const std::string& body, double x_m) {
    EXPECT_EQ(environment_.apply({"test", PlaceBody{body, x_m, 0.5}}), "");
    step();
  }
  void step() {
    environment_.step();
    Supervisor supervisor(environment_, "referee");
    referee_.observe(environment_);
    referee_.supervise(supervisor);
  }
  double ball_x() const { return environment_.objects()[0].body.world_from_body.x; }
  double metric(std::size_t i) const { return referee_.metrics()[i].value; }

  LoadedWorld world_ = pitch();
  Environment environment_;
  SoccerReferee referee_{{}, {.goal_x_m = 4, .stuck_s = 2, .goals = 2}};
};

TEST_F(RefereeOnAPitch, CountsAGoalWhenAllOfTheBallIsBehindTheLineAndMakesTheKickOff) {
  place("R", -3);
  place("Ball", 4.09);
  EXPECT_EQ(metric(0), 0);
  place("Ball", 4.11);
  EXPECT_EQ(metric(0), 1);
  EXPECT_EQ(metric(1), 0);
  EXPECT_EQ(ball_x(), 0);
  EXPECT_EQ(environment_.state().world_from_robot[0].x, -1) << "at its start";
  step();
  EXPECT_EQ(metric(0), 1) << "counted once";
}

TEST_F(RefereeOnAPitch, PutsABallBackThatDoesNotMove) {
  place("Ball", -3);
  for (int i = 0; i < 19; ++i) step();
  EXPECT_EQ(ball_x(), -3);
  step();  // after two seconds
  EXPECT_EQ(ball_x(), 0);
  EXPECT_EQ(metric(2), 1);
}

TEST_F(RefereeOnAPitch, EndsTheGameAtTheNumberOfGoals) {
  place("Ball", -4.2);
  place("Ball", 4.2);
  EXPECT_FALSE(environment_.state().ended);
  place("Ball", -4.2);
  ASSERT_TRUE(environment_.state().ended);
  EXPECT_EQ(environment_.state().ended->outcome, "east_team_won");
  EXPECT_EQ(environment_.state().ended->text, "1 : 2");
}

TEST(SoccerReferee, RefusesAWorldWithoutABall) {
  const LoadedWorld world = pitch("Crate");
  const Environment environment(world.world, world.fleet, {});
  SoccerReferee referee({}, {});
  EXPECT_THROW(referee.observe(environment), std::runtime_error);
}

}  // namespace
}  // namespace robosim
