// Interventions from outside: by world files and by supervisors, in recordings and their repetition.
#include <fstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/scenarios/recorded_run.h"
#include "tests/scenarios/robot_processes.h"
#include "tests/scenarios/serving.h"

namespace robosim {
namespace {

/// A corridor of 10 m with a robot that wanders towards +x, another that stands at its end, and a pillar beside the
/// way.
std::string corridor(const std::string& timeline) {
  return "<world><surface><size><xmin>-1</xmin><xmax>9</xmax><ymin>-2</ymin><ymax>2</ymax></size>"
         "<object><shape><primitive><cylinder><name>pillar</name><x>3</x><y>1.5</y><z>0.5</z><radius>0.2</radius>"
         "<height>1</height></cylinder></primitive></shape></object>"
         "<object><shape><robot><model>scout</model><name>R</name><x>0</x><y>0</y><direction>0</direction>"
         "<controller>wander</controller></robot></shape></object><object><shape><robot><model>scout</model><name>S</"
         "name>"
         "<x>8</x><y>1</y><direction>0</direction><controller>still</controller></robot></shape></object></surface>" +
         timeline + "</world>";
}

/// A world file in an empty folder.
std::filesystem::path written(const std::string& text) {
  const auto file = emptyFolder() / "world.xml";
  std::ofstream(file) << text;
  return file;
}

TEST(Interventions, OfAWorldFileAreRecordedAndRepeated) {
  const auto world =
      written(corridor("<at time=\"2\"><place name=\"pillar\" x=\"3\" y=\"0\"/><remove name=\"S\"/></at>"
                       "<at time=\"4\"><place name=\"S\" x=\"7\" y=\"-1\"/></at>"
                       "<at time=\"8\"><end outcome=\"blocked\" text=\"the pillar stands in the way\"/></at>"));
  const auto rawlog = world.parent_path() / "run.rawlog";
  const auto run = recordRun(quoted(world) + " --time 60", rawlog);
  EXPECT_EQ(run["ended_by"], "intervention");
  EXPECT_EQ(run["end_outcome"], "blocked");
  EXPECT_EQ(run["end_reason"], "the pillar stands in the way");
  EXPECT_EQ(run["interventions"], 4);
  EXPECT_EQ(run["steps"], 81) << "the end is decided before step 81";
  const Ended check = runProgram("replay --check " + quoted(world) + " " + quoted(rawlog));
  EXPECT_EQ(check.out, "The same run: 81 steps, digest " + run["digest"].get<std::string>() + "\n") << check.err;
}

TEST(Interventions, OfAWorldFileThatAddRobotsAreRecordedAndRepeated) {
  const auto world = written(corridor(
      "<at time=\"2\"><add><robot model=\"pioneer3dx\" name=\"T\" x=\"4\" y=\"-1\"><controller>wander</controller>"
      "</robot></add></at><at time=\"4\"><place name=\"T\" x=\"7\" y=\"-1\"/><remove name=\"S\"/></at>"));
  for (const char* name : {"run.rawlog", "run.mcap"}) {
    const auto recording = world.parent_path() / name;
    const auto run = recordRun(quoted(world) + " --time 8", recording);
    EXPECT_EQ(run["robots"], 3);
    EXPECT_EQ(run["interventions"], 3);
    const Ended check = runProgram("replay --check " + quoted(world) + " " + quoted(recording));
    EXPECT_EQ(check.out, "The same run: 80 steps, digest " + run["digest"].get<std::string>() + "\n") << check.err;
  }
}

TEST(Interventions, OfAWorldFileThatNameNothingInItAreRefusedWithTheirLine) {
  const auto world = written(corridor("\n<at time=\"2\"><remove name=\"pilar\"/></at>"));
  EXPECT_EQ(
      refusalOf("run " + quoted(world)),
      "robosim run: " + world.string() + ":2: 'pilar' is not the name of a robot or an object; did you mean pillar?\n");
}

// A geometry worker computes half of the readings.
TEST(Interventions, OfASupervisorAreRecordedWithTheirAuthorAndRepeated) {
  const auto world = written(corridor(""));
  const auto rawlog = world.parent_path() / "run.rawlog";
  Serving serving({"--paused", "--time", "6", "--record", rawlog.string()}, world.string());
  const auto worker = startWorker(serving.address());
  serving.program().waitForError(": ready");
  const auto control = [&](const std::string& arguments) {
    return runProgram("control " + serving.address() + " " + arguments);
  };
  EXPECT_EQ(control("step 10").exit_code, 0);
  const Ended refused = control("place pillar 8 1");
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find("'pillar' would overlap 'S'; choose another place"), std::string::npos) << refused.err;
  for (const char* change :
       {"place pillar 2 0",
        "add \"<cube><name>box</name><x>5</x><y>-1</y><z>0.5</z><length>1</length><width>0.5</width>"
        "<height>1</height></cube>\"",
        "change box --heat 30 --color 1,0,0", "activity R halted", "activity R active", "remove box", "remove R",
        "place R -0.5 1 90"}) {
    const Ended done = control(change);
    EXPECT_EQ(done.exit_code, 0) << change << done.err;
    EXPECT_EQ(control("step 5").exit_code, 0);
  }
  EXPECT_EQ(control("start").exit_code, 0);
  const Ended served = serving.program().wait();
  EXPECT_EQ(served.exit_code, 0) << served.err;
  EXPECT_NE(served.out.find("interventions  8"), std::string::npos) << served.out;
  const Ended check = runProgram("replay --check " + quoted(world) + " " + quoted(rawlog));
  EXPECT_EQ(check.exit_code, 0) << check.out << check.err;
  EXPECT_TRUE(check.out.starts_with("The same run: 60 steps")) << check.out;

  // In another world, an intervention is impossible.
  std::string without = corridor("");
  without.replace(without.find("pillar"), 6, "column");
  std::ofstream(world) << without;
  const Ended other = runProgram("replay --check " + quoted(world) + " " + quoted(rawlog));
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_NE(other.out.find("the intervention of anyone is impossible now: 'pillar' is not the name of a robot"),
            std::string::npos)
      << other.out;
}

// A geometry worker computes half of the readings until the first is added.
TEST(Interventions, ThatAddRobotsAreServedRecordedAndRepeated) {
  const auto world = written(corridor(""));
  const auto rawlog = world.parent_path() / "run.rawlog";
  Serving serving({"--paused", "--time", "6", "--record", rawlog.string()}, world.string());
  const auto worker = startWorker(serving.address());
  serving.program().waitForError(": ready");
  const auto control = [&](const std::string& arguments) {
    return runProgram("control " + serving.address() + " " + arguments);
  };
  EXPECT_EQ(control("step 10").exit_code, 0);
  const std::string with_controller =
      "add '<robot model=\"scout\" name=\"T\" x=\"4\" y=\"-1\"><controller>wander</controller></robot>'";
  EXPECT_EQ(control(with_controller).exit_code, 0);
  EXPECT_EQ(control(with_controller).exit_code, 2) << "the name is taken";
  EXPECT_EQ(control("step 10").exit_code, 0);
  EXPECT_EQ(control("add '<robot model=\"pioneer3dx\" name=\"U\" x=\"6\" y=\"-1\"/>'").exit_code, 0);
  serving.program().waitForError("waiting for U");
  const auto robot = startRobots({"U"}, serving.address());
  EXPECT_EQ(control("start").exit_code, 0);
  const Ended served = serving.program().wait();
  EXPECT_EQ(robot->wait().exit_code, 0);
  EXPECT_EQ(served.exit_code, 0) << served.err;
  EXPECT_NE(served.out.find("robots         4"), std::string::npos) << served.out;
  const Ended check = runProgram("replay --check " + quoted(world) + " " + quoted(rawlog));
  EXPECT_TRUE(check.out.starts_with("The same run: 60 steps")) << check.out << check.err;
}

TEST(Interventions, NeedATokenOfASupervisorWhereTokensAreRequired) {
  const auto world = written(corridor(""));
  const auto tokens = world.parent_path() / "tokens";
  const auto token = [&](const std::string& name) {
    const auto file = world.parent_path() / name;
    std::ofstream(file) << name << "_0123456789";
    std::filesystem::permissions(file, std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
    return file;
  };
  std::ofstream(tokens) << "director_0123456789 operator name=director\nreferee_0123456789 supervisor name=referee\n";
  std::filesystem::permissions(tokens, std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
  Serving serving({"--paused", "--time", "1", "--tokens", tokens.string()}, world.string());
  const auto control = [&](const std::string& name, const std::string& arguments) {
    return runProgram("control " + serving.address() + " --send-token-unencrypted --token-file " + quoted(token(name)) +
                      " " + arguments);
  };
  EXPECT_EQ(control("referee", "place pillar 2 0").exit_code, 0);
  EXPECT_NE(control("director", "place pillar 3 0").err.find("does not permit to change the run"), std::string::npos);
  EXPECT_NE(control("referee", "start").err.find("permits only to watch and to change the run"), std::string::npos);
  EXPECT_EQ(control("director", "stop").exit_code, 0);
  const Ended served = serving.program().wait();
  EXPECT_NE(served.err.find(": supervise <place name=\"pillar\" x=\"2\" y=\"0\"/>"), std::string::npos) << served.err;
  EXPECT_NE(served.err.find(" referee ("), std::string::npos) << served.err;
}

}  // namespace
}  // namespace robosim
