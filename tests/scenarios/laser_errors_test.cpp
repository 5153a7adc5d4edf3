// A world with all errors of laser scanners, in runs of the program.
#include <fstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/testing/test_folder.h"
#include "tests/scenarios/robot_processes.h"
#include "tests/scenarios/serving.h"

namespace robosim {
namespace {

/// Three robots with every type of scanner among dark and bright objects.
std::string worldWith(const std::string& noise) {
  std::string world =
      "<world><surface><type>smooth</type><size><xmin>-5</xmin><xmax>5</xmax><ymin>-5</ymin>"
      "<ymax>5</ymax></size>\n";
  const char* const reflectivities[] = {"0.05", "0.5", "1"};
  for (int i = 0; i < 3; ++i) {
    const std::string n = std::to_string(i);
    world += "<object><shape><primitive><cylinder><name>pillar" + n + "</name><x>" + std::to_string(3 * i - 3) +
             "</x><y>2</y><z>0.5</z><radius>0.3</radius><height>1</height><reflectivity>" + reflectivities[i] +
             "</reflectivity></cylinder></primitive></shape></object>\n";
    world += "<object><shape><robot><model>pioneer3dx</model><name>R" + n + "</name><x>" + std::to_string(3 * i - 3) +
             "</x><y>-2</y><controller>wander</controller><sensors>" + noise + "</sensors></robot></shape></object>\n";
  }
  return world + "</surface></world>\n";
}

constexpr const char* kAllErrors =
    "<laser label='a' noise='lms200' z_m='0.2' latency_s='0.01'/>"
    "<laser label='b' noise='urg04lx' z_m='0.2' beams='240' field_of_view_deg='240' range_max_m='4' rate_hz='4'/>"
    "<laser label='c' noise='utm30lx' z_m='0.2' beams='271' field_of_view_deg='270' range_max_m='30' pans='1'/>";

class LaserErrorsInRuns : public TestFolder {};

std::string digestOf(const std::filesystem::path& world, const std::string& options) {
  const Ended run = runProgram("run " + quoted(world) + " --time 20 --json " + options);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  return nlohmann::json::parse(run.out)["digest"];
}

TEST_F(LaserErrorsInRuns, AreIndependentOfTheNumberOfThreads) {
  const auto world = in("world.xml");
  std::ofstream(world) << worldWith(kAllErrors);
  const std::string alone = digestOf(world, "--threads 1");
  EXPECT_EQ(digestOf(world, "--threads 2"), alone);
  EXPECT_EQ(digestOf(world, "--threads 3"), alone);
  EXPECT_NE(digestOf(world, "--threads 1 --seed 2"), alone);
}

TEST_F(LaserErrorsInRuns, AreTheSameWithAGeometryWorker) {
  const auto world = in("world.xml");
  std::ofstream(world) << worldWith(kAllErrors);
  const Ended alone = runProgram("run " + quoted(world) + " --time 2 --json");
  Serving serving({"--paused", "--time", "2", "--json"}, world.string());
  const auto worker = startWorker(serving.address());
  serving.program().waitForError(": ready");
  EXPECT_EQ(runProgram("control " + serving.address() + " start").exit_code, 0);
  const Ended ended = serving.program().wait();
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  const auto served = nlohmann::json::parse(ended.out);
  EXPECT_EQ(served["digest"], nlohmann::json::parse(alone.out)["digest"]);
  EXPECT_EQ(served["clients"]["trusted"], true);
  EXPECT_GT(served["clients"]["geometry_results"], 0);
}

TEST_F(LaserErrorsInRuns, AreReportedByCheckWithFileAndLine) {
  const auto world = in("world.xml");
  std::ofstream(world) << worldWith("<laser noise='lms100'/>");
  const Ended checked = runProgram("check " + quoted(world));
  EXPECT_EQ(checked.exit_code, 1);
  EXPECT_NE((checked.out + checked.err)
                .find("world.xml:3: <laser noise=\"lms100\">: is not a type of scanner; accepted are: lms200, "
                      "urg04lx, utm30lx"),
            std::string::npos)
      << checked.out << checked.err;
}

}  // namespace
}  // namespace robosim
