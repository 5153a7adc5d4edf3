#include "environment/world_changes.h"

#include <cmath>

#include <gtest/gtest.h>

#include "environment/environment.h"

namespace robosim {
namespace {

using Lines = std::vector<std::string>;

/// A square of 10 m with a pillar of 1 m in its middle, in units of 10 cm.
WorldSource square(const std::string& more = "") {
  return {.file = "square.xml",
          .text =
              "<world unit_m='0.1'><surface><size><xmin>-50</xmin><xmax>50</xmax><ymin>-50</ymin><ymax>50</ymax>"
              "</size><object><shape><primitive><cylinder><name>Robot1</name><x>0</x><y>0</y><z>5</z>"
              "<radius>10</radius><height>10</height></cylinder></primitive></shape></object>" +
              more + "</surface></world>",
          .robot_types = {}};
}

WorldChanges robots(const Lines& texts) {
  WorldChanges changes;
  for (const auto& text : texts) changes.robots.push_back(AddedRobot::parse(text));
  return changes;
}

LoadedWorld changed(const WorldChanges& changes, std::uint64_t seed = 1, const WorldSource& source = square()) {
  return loadWorld(withChanges(source, changes, seed), {});
}

Lines faults(const WorldChanges& changes) {
  try {
    changed(changes);
  } catch (const ConfigError& error) {
    return error.errors();
  }
  return {};
}

std::string fault(const std::string& robot) {
  try {
    AddedRobot::parse(robot);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "";
}

TEST(AddedRobot, ParsesTypePositionAndHeading) {
  const AddedRobot robot = AddedRobot::parse("pioneer3dx@1,-2.5,90");
  EXPECT_EQ(robot.model, "pioneer3dx");
  EXPECT_EQ(robot.world_from_robot, mrpt::math::TPose2D(1, -2.5, M_PI / 2));
  EXPECT_EQ(AddedRobot::parse("scout@0,1").world_from_robot, mrpt::math::TPose2D(0, 1, 0));
}

TEST(AddedRobot, RejectsOtherFormsWithAnExample) {
  for (const std::string text : {"scout", "scout@", "scout@1", "scout@1,2,3,4", "@1,2", "scout@1,,2", "scout@1,2,",
                                 "scout@1,x", "scout@nan,0", "scout@1,1e300"}) {
    EXPECT_EQ(
        fault(text),
        "--robot " + text + ": must be TYPE@X,Y or TYPE@X,Y,HEADING, in metres and degrees, as in pioneer3dx@1,2,90");
  }
}

TEST(WorldChanges, AddRobotsUnderFreeNames) {
  const LoadedWorld world = changed(robots({"pioneer3dx@-2,1.5,90", "scout@3,0"}));
  ASSERT_EQ(world.fleet.robots.size(), 2u);
  EXPECT_EQ(world.fleet.robots[0].info.name, "Robot2") << "the pillar is named Robot1";
  EXPECT_EQ(world.fleet.robots[0].info.type->model, "pioneer3dx");
  EXPECT_EQ(world.fleet.robots[0].world_from_start, mrpt::math::TPose2D(-2, 1.5, M_PI / 2));
  EXPECT_EQ(world.fleet.robots[1].info.name, "Robot3");
}

TEST(WorldChanges, RejectAnOverlappingRobotWithPositionAndReason) {
  EXPECT_EQ(faults(robots({"scout@3,0", "scout@1.1,0"})),
            (Lines{"square.xml: robot 'Robot3' at (1.1, 0) m overlaps the object 'Robot1' of line 1; move one of them",
                   "square.xml: the robots of --robot are Robot2, Robot3, in their order"}));
}

TEST(WorldChanges, RejectAnUnknownType) {
  const Lines lines = faults(robots({"rover@3,0"}));
  ASSERT_FALSE(lines.empty());
  EXPECT_EQ(lines[0].find("square.xml: robot 'Robot2': there is no robot type 'rover'; known are: amigo-sh"), 0u)
      << lines[0];
}

TEST(WorldChanges, PlaceRandomRobotsFreelyByTheSeed) {
  WorldChanges changes = robots({"pioneer3dx@4,4"});
  changes.random_robots = 20;
  changes.random_model = "scout";
  const auto places = [&](std::uint64_t seed) {
    std::vector<mrpt::math::TPose2D> poses;
    for (const auto& robot : changed(changes, seed).fleet.robots) poses.push_back(robot.world_from_start);
    return poses;  // loadWorld() rejects overlaps
  };
  EXPECT_EQ(places(1).size(), 21u);
  EXPECT_EQ(places(1), places(1));
  EXPECT_NE(places(1), places(2));
  EXPECT_EQ(places(1)[0], places(2)[0]) << "its position is given";
}

Lines neighboursOf(const LoadedWorld& world) {
  Lines names;
  for (const auto& robot : world.fleet.robots) names.push_back(robot.info.name + ">" + *robot.info.neighbour);
  return names;
}

TEST(WorldChanges, LinkRandomRobotsAsARing) {
  WorldChanges changes;
  changes.random_robots = 3;
  EXPECT_EQ(neighboursOf(changed(changes)), (Lines{"Robot2>Robot3", "Robot3>Robot4", "Robot4>Robot2"}));
  changes.random_robots = 1;
  EXPECT_EQ(neighboursOf(changed(changes)), Lines{"Robot2>"});
}

TEST(WorldChanges, InsertRandomRobotsIntoTheRingOfTheWorld) {
  const auto robot = [](const std::string& name, const std::string& x, const std::string& neighbour) {
    return "<object><shape><robot><model>scout</model><name>" + name + "</name><x>" + x + "</x><y>30</y><neighbour>" +
           neighbour + "</neighbour></robot></shape></object>";
  };
  WorldChanges changes;
  changes.random_robots = 2;
  EXPECT_EQ(neighboursOf(changed(changes, 1, square(robot("A", "-30", "B") + robot("B", "30", "A")))),
            (Lines{"A>Robot2", "B>A", "Robot2>Robot3", "Robot3>B"}));
}

TEST(WorldChanges, RejectMoreRandomRobotsThanFit) {
  WorldChanges changes;
  changes.random_robots = 2000;  // 10 m × 10 m have room for fewer than 700 discs of 0.38 m
  const Lines lines = faults(changes);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0].find("--random-robots 2000: there is room for "), 0u) << lines[0];
}

TEST(WorldChanges, ReplaceTheRobotsByATeamOfTheFirstOnesKind) {
  const std::string given =
      "<object><shape><robot><model>scout</model><name>A</name><x>30</x><y>0</y><controller>wander</controller>"
      "</robot></shape></object><object><shape><robot><model>pioneer3dx</model><name>B</name><x>-30</x><y>0</y>"
      "</robot></shape></object>";
  WorldChanges changes;
  changes.team = 12;
  const LoadedWorld team = changed(changes, 1, square(given));
  ASSERT_EQ(team.fleet.robots.size(), 12u);
  for (std::size_t i = 0; i < 12; ++i) {
    EXPECT_EQ(team.world.robots[i].model, "scout");
    EXPECT_EQ(*team.fleet.robots[i].controller, "wander");
    EXPECT_EQ(team.fleet.robots[i].info.neighbour, team.fleet.robots[(i + 1) % 12].info.name);
  }
  changes.team = 1;
  EXPECT_EQ(changed(changes, 1, square(given)).fleet.robots[0].info.neighbour, "");
  EXPECT_EQ(faults(changes), Lines{"square.xml: has no robots, so that a team of them cannot be made"});
}

TEST(WorldChanges, RejectATeamThatDoesNotFit) {
  const std::string given =
      "<object><shape><robot><model>scout</model><name>A</name><x>30</x><y>0</y></robot></shape></object>";
  WorldChanges changes;
  changes.team = 2000;
  try {
    changed(changes, 1, square(given));
    FAIL();
  } catch (const ConfigError& error) {
    EXPECT_NE(std::string(error.what()).find("of 2000 robots only; use a smaller team"), std::string::npos)
        << error.what();
  }
}

TEST(WorldChanges, SetTheLossOfMessages) {
  WorldChanges changes = robots({"pioneer3dx@3,0"});
  changes.message_loss = 0.25;
  EXPECT_EQ(changed(changes).world.communication.loss_probability, 0.25);
}

TEST(WorldChanges, AddErrorsOfTheRadioToAWorldThatDoesNotSpecifyIt) {
  const auto radioOf = [](const WorldChanges& changes, const std::string& radio) {
    WorldSource source = square();
    source.text.insert(source.text.find("</world>"), radio);
    return changed(changes, 1, source).world.communication;
  };
  WorldChanges changes = robots({"pioneer3dx@3,0"});
  EXPECT_EQ(radioOf(changes, ""), Communication());
  changes.adds_radio_errors = true;
  EXPECT_EQ(radioOf(changes, ""), kAddedRadio);
  EXPECT_EQ(radioOf(changes, "<communication/>"), Communication()) << "exact";
  EXPECT_EQ(radioOf(changes, "<communication delay_s='0.5'/>"), (Communication{.delay_s = 0.5}));
  changes.message_loss = 0.25;
  Communication lossy = kAddedRadio;
  lossy.loss_probability = 0.25;
  EXPECT_EQ(radioOf(changes, ""), lossy);
}

TEST(WorldChanges, MoveOnlyTheStartPoses) {
  const std::string robot =
      "<object><shape><robot><model>scout</model><name>A</name><x>30</x><y>0</y><controller>wander</controller>"
      "</robot></shape></object>";
  WorldChanges changes;
  changes.has_random_starts = true;
  const LoadedWorld one = changed(changes, 1, square(robot)), other = changed(changes, 2, square(robot));
  EXPECT_NE(one.fleet.robots[0].world_from_start, other.fleet.robots[0].world_from_start);
  EXPECT_EQ(*one.fleet.robots[0].controller, "wander");
  EXPECT_EQ(one.world.objects, other.world.objects);
}

TEST(WorldChanges, AddNoiseToSensorsWithout) {
  const std::string described =
      "<object><shape><robot><model>scout</model><name>B</name><x>-30</x><y>0</y><sensors><laser beams='2'/>"
      "<compass><noise std_deg='0'/></compass></sensors></robot></shape></object>";
  WorldChanges changes = robots({"pioneer3dx@3,0"});
  const auto noisy = [&] {
    std::string labels;
    for (const auto& robot : changed(changes, 1, square(described)).fleet.robots) {
      for (const auto& sensor : robot.model->sensors) {
        if (sensor->isNoisy()) labels += robot.info.name + "/" + sensor->info().label + " ";
      }
    }
    return labels;
  };
  EXPECT_EQ(noisy(), "");
  changes.noise = AddedNoise::typical;
  EXPECT_EQ(noisy(), "B/laser Robot2/sonar Robot2/laser Robot2/heat Robot2/odometry Robot2/compass ");
}

}  // namespace
}  // namespace robosim
