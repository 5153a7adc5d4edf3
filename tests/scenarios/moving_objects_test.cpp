// Objects that move: in recordings, their repetition and views, and with geometry workers.
#include <cmath>
#include <fstream>

#include <gtest/gtest.h>

#include "tests/scenarios/recorded_run.h"
#include "tests/scenarios/robot_processes.h"
#include "tests/scenarios/serving.h"
#include "viewing/recorded_moments.h"

namespace robosim {
namespace {

/// A robot that drives along the x axis against a crate, and through a door at x = 4 m. Both are lower than its sonars.
const char* const kHall = R"(<world><surface>
  <size><xmin>-1</xmin><xmax>9</xmax><ymin>-2</ymin><ymax>2</ymax></size>
  <object><shape><primitive><cube><name>crate</name><x>1.5</x><y>0</y><z>0.05</z><length>0.4</length><width>0.4</width>
    <height>0.1</height><movable mass_kg="2"/></cube></primitive></shape></object>
  <object><shape><primitive><cube><name>door</name><x>4</x><y>0</y><z>0.05</z><length>1</length><width>0.1</width>
    <height>0.1</height><direction>1.5707963267948966</direction><door slide="1.2" speed="2" opens_within="1"/></cube>
  </primitive></shape></object>
  <object><shape><robot><model>scout</model><name>R</name><x>0</x><y>0</y><controller>wander</controller></robot></shape>
  </object></surface></world>)";

std::filesystem::path hall() {
  const auto file = emptyFolder() / "world.xml";
  std::ofstream(file) << kHall;
  return file;
}

TEST(MovingObjects, AreWhereTheyWereInViewsOfARecording) {
  const auto world = hall();
  const auto rawlog = world.parent_path() / "run.rawlog";
  const auto run = recordRun(quoted(world) + " --time 12", rawlog);
  const Ended check = runProgram("replay --check " + quoted(world) + " " + quoted(rawlog));
  EXPECT_EQ(check.out, "The same run: 120 steps, digest " + run["digest"].get<std::string>() + "\n") << check.err;

  const auto moments = readMoments(rawlog.string());
  const auto& at_start = moments->world().world.objects;
  const auto objects = [&](std::size_t moment) { return moments->at(moment).objects.orThose(at_start); };
  EXPECT_EQ(objects(0), at_start);
  double pushed_m = 0, opened_m = 0;
  for (std::size_t moment = 0; moment < moments->times().size(); ++moment) {
    const auto snapshot = moments->at(moment);
    const auto now = objects(moment);
    const auto& crate = now[0].body.world_from_body;
    const auto& robot = snapshot.robots[0].world_from_robot;
    // The crate is never nearer to the robot's centre than its side and the robot's radius of 0.19 m permit.
    EXPECT_GE(std::hypot(crate.x - robot.x, crate.y - robot.y), 0.19 + 0.2 - 1e-6) << moment;
    pushed_m = std::max(pushed_m, crate.x - 1.5);
    opened_m = std::max(opened_m, now[1].body.world_from_body.y);
  }
  EXPECT_GT(pushed_m, 0.5);
  EXPECT_NEAR(opened_m, 1.2, 1e-9);
}

TEST(MovingObjects, MakeTheSameRunWithAGeometryWorker) {
  const auto world = hall();
  const Ended alone = runProgram("run " + quoted(world) + " --time 12 --json");
  Serving serving({"--paused", "--time", "12", "--json"}, world.string());
  const auto worker = startWorker(serving.address());
  serving.program().waitForError(": ready");
  EXPECT_EQ(runProgram("control " + serving.address() + " start").exit_code, 0);
  const Ended served = serving.program().wait();
  EXPECT_EQ(served.exit_code, 0) << served.err;
  const auto digest_of = [](const Ended& ended) { return nlohmann::json::parse(ended.out).at("digest"); };
  EXPECT_EQ(digest_of(served), digest_of(alone));
}

TEST(MovingObjects, ThatOverlapAtTheStartAreReportedWithTheirLines) {
  const auto file = emptyFolder() / "world.xml";
  std::ofstream(file) << R"(<world><surface><size><xmin>-1</xmin><xmax>1</xmax><ymin>-1</ymin><ymax>1</ymax></size>
<object><shape><primitive><cylinder><name>ball</name><x>0.9</x><y>0</y><z>0.1</z><radius>0.2</radius><height>0.2</height>
<movable/></cylinder></primitive></shape></object>
<object><shape><primitive><cylinder><name>post</name><x>0.6</x><y>0</y><z>0.1</z><radius>0.2</radius><height>0.2</height>
</cylinder></primitive></shape></object></surface></world>)";
  const Ended check = runProgram("check " + quoted(file));
  EXPECT_EQ(check.exit_code, 1);
  const std::string errors = check.out + check.err;
  const std::string at = file.string() + ":2: the movable object 'ball' at (0.9, 0) m ";
  EXPECT_NE(errors.find(at + "stands outside the surface, or reaches over its edge; move it inside"), std::string::npos)
      << errors;
  EXPECT_NE(errors.find(at + "overlaps the object 'post' of line 4; move one of them"), std::string::npos) << errors;
}

}  // namespace
}  // namespace robosim
