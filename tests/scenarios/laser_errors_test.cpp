// A world with all errors of laser scanners, in runs of the program.
#include <fstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/testing/test_folder.h"
#include "recording/observations.h"
#include "recording/rawlog_reader.h"
#include "tests/scenarios/robot_processes.h"
#include "tests/scenarios/serving.h"
#include "viewing/recorded_moments.h"

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

TEST_F(LaserErrorsInRuns, AreRecordedOnceForEachScan) {
  const auto world = in("world.xml"), rawlog = in("run.rawlog");
  std::ofstream(world) << worldWith(
      "<laser label='scanner' noise='lms200' z_m='0.2' beams='360' field_of_view_deg='359' rate_hz='5'/>");
  ASSERT_EQ(runProgram("run " + quoted(world) + " --time 10 --record " + quoted(rawlog)).exit_code, 0);

  // Five scans per second from 0 s to 10 s.
  std::vector<double> times_s;
  RawlogReader reader(rawlog);
  while (const auto observation = reader.next()) {
    if (observation->sensorLabel == "R1/scanner") times_s.push_back(secondsSinceStart(observation->timestamp));
  }
  ASSERT_EQ(times_s.size(), 51u);
  for (std::size_t i = 0; i < times_s.size(); ++i) EXPECT_NEAR(times_s[i], 0.2 * static_cast<double>(i), 1e-6);

  const Ended summary = runProgram("replay " + quoted(rawlog) + " --json");
  for (const auto& channel : nlohmann::json::parse(summary.out)["channels"]) {
    if (channel["label"] != "R1/scanner") continue;
    EXPECT_EQ(channel["count"], 51);
    EXPECT_NEAR(channel["rate_hz"].get<double>(), 5, 1e-6);
  }
  const Ended checked = runProgram("replay " + quoted(rawlog) + " --check " + quoted(world));
  EXPECT_NE(checked.out.find("The same run: 100 steps"), std::string::npos) << checked.out << checked.err;
  const Ended driven = runProgram("replay " + quoted(rawlog) + " --controller recorded");
  EXPECT_NE(driven.out.find("all 100 commands are the recorded ones"), std::string::npos) << driven.out << driven.err;

  // At 4.1 s and 4.9 s, the scans of 4.0 s and 4.8 s are shown.
  const auto moments = readMoments(rawlog.string());
  ASSERT_EQ(moments->times().size(), 101u);
  const auto scan_at = [&](std::size_t step) {
    const RunSnapshot moment = moments->at(step);
    EXPECT_NEAR(moment.time_s, 0.1 * static_cast<double>(step), 1e-9);
    const auto& sensors = *moments->world().fleet.robots[1].info.sensors;
    for (std::size_t slot = 0; slot < sensors.size(); ++slot) {
      if (sensors[slot].label == "scanner") return moment.robots[1].readings->measurements[slot];
    }
    return Measurement();
  };
  const Measurement of_48 = scan_at(48);
  EXPECT_EQ(scan_at(49), of_48);
  EXPECT_NE(scan_at(50), of_48);
  EXPECT_EQ(scan_at(41), scan_at(40));
  EXPECT_NE(scan_at(41), of_48);
}

}  // namespace
}  // namespace robosim
