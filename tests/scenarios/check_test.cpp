// `robosim check` and `robosim bench gold` from the command line.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "environment/start_poses.h"
#include "run/local_run.h"
#include "tests/scenarios/program.h"

namespace robosim {
namespace {

using nlohmann::json;

TEST(Check, SummarisesAValidWorld) {
  const Ended check = runProgram("check worlds/opho2_1.xml");
  EXPECT_EQ(check.exit_code, 0);
  EXPECT_EQ(check.out.substr(0, 2), "ok");
  EXPECT_NE(check.out.find("Finder1"), std::string::npos);
}

TEST(Check, PrintsTheSummaryAsJson) {
  const json ok = json::parse(runProgram("check --json worlds/opho2_1.xml").out);
  EXPECT_EQ(ok["ok"], true);
  EXPECT_EQ(ok["errors"], json::array());
  EXPECT_EQ(ok["robots"], (json{"Finder1", "Finder2", "Finder3", "Finder4"}));
  EXPECT_EQ(ok["objects"], 15);
  EXPECT_EQ(ok["error_models"]["sensors"], json::array());
  EXPECT_EQ(ok["error_models"]["communication"], nullptr);
}

TEST(Check, ListsEveryErrorOfAFile) {
  const auto file = emptyFolder() / "bad.xml";
  std::ofstream(file) << R"(<?xml version="1.0"?>
<world>
  <surface>
    <size><xmin>-5</xmin><xmax>5</xmax><ymin>-5</ymin><ymax>five</ymax></size>
    <object><shape><primitive><cylinder>
      <name>A</name><x>0</x><y>0</y><z>1</z><radius>-1</radius><height>2</height>
    </cylinder></primitive></shape></object>
    <object><shape><robot>
      <model>pioneer9</model><name>R</name><x>1</x><y>1</y><direction>0</direction>
    </robot></shape></object>
    <colour>1 0 0</colour>
  </surface>
</world>
)";
  const Ended check = runProgram("check --json '" + file.string() + "'");
  EXPECT_EQ(check.exit_code, 1);
  const json result = json::parse(check.out);
  EXPECT_EQ(result["ok"], false);
  const std::string all = result["errors"].dump();
  for (const char* place : {"bad.xml:4: ", "bad.xml:6: ", "bad.xml:8: ", "bad.xml:11: "}) {
    EXPECT_NE(all.find(place), std::string::npos) << place << all;
  }
}

TEST(Check, PrintsTheErrorsOfSensorsAndRadioWithAllSettings) {
  const auto folder = emptyFolder();
  std::filesystem::create_directory(folder / "robots");
  std::ofstream(folder / "robots" / "noisy.xml") << R"(<robot name="noisy"><body radius_m="0.2" height_m="0.3"/>
<limits speed_max_mps="1" accel_mps2="1" decel_mps2="1" turn_max_degps="90" turn_accel_degps2="90"/>
<sensors><sonar noise="polaroid"><noise dropout="0.05"/><at/></sonar><heat/><compass><noise hard_iron_deg="5"/></compass>
<odometry/><laser latency_s="0.2"/><laser noise="lms200" rate_hz="5"><noise><at range_m="1" std_m="0.01"/>
<at range_m="9" std_m="0.02"/></noise></laser></sensors></robot>)";
  const auto world = folder / "world.xml";
  std::ofstream(world) << R"(<world><surface><type>smooth</type><size><xmin>-5</xmin><xmax>5</xmax><ymin>-5</ymin>
<ymax>5</ymax></size><object><shape><robot><model>noisy</model><name>A</name><x>0</x><y>0</y></robot></shape></object>
<object><shape><primitive><cylinder><name>Mirror</name><x>3</x><y>0</y><z>0.5</z><radius>0.2</radius><height>1</height>
<reflectivity>0.9</reflectivity></cylinder></primitive></shape></object>
</surface><communication range="9" delay_s="0.2"/></world>)";
  const std::string compass =
      "compass: noise; hard_iron_deg 5; by default std_deg 2, offset_deg 0, hard_iron_at_deg 0, soft_iron_deg 0, "
      "soft_iron_at_deg 0, gyro_drift_deg_per_h 0\n";
  for (const auto& file : {world, folder / "robots" / "noisy.xml"}) {
    const std::string out = runProgram("check '" + file.string() + "'").out;
    EXPECT_NE(out.find("sonar: noise polaroid; dropout 0.05; by default std_m 0, std_per_m 0.01,"), std::string::npos)
        << out;
    EXPECT_NE(out.find("robot_crosstalk 0.02, firing_interval_s 0, array 8\n"), std::string::npos) << out;
    EXPECT_NE(out.find("  laser: latency_s 0.2; by default sweep_s 0, latency_std_s 0, latency_tail 0, "
                       "latency_tail_factor 3, rate_hz 0, phase_s 0, interlace_s 0\n"),
              std::string::npos)
        << out;
    EXPECT_NE(out.find("  laser: noise lms200; at (range_m 1, std_m 0.01), at (range_m 9, std_m 0.02), rate_hz 5; by "
                       "default tail 0.03"),
              std::string::npos)
        << out;
    EXPECT_NE(out.find(compass), std::string::npos) << out;
    EXPECT_EQ(out.find("heat:"), std::string::npos) << out;
  }
  const std::string out = runProgram("check '" + world.string() + "'").out;
  EXPECT_NE(out.find("range 9 m, loss 0, wall_range 0 m, wall_loss 0"), std::string::npos) << out;
  EXPECT_NE(out.find("Mirror 0.9; by default 0.5\n"), std::string::npos) << out;
  const json models = json::parse(runProgram("check --json '" + world.string() + "'").out)["error_models"];
  EXPECT_EQ(models["communication"]["range"], 9);
  EXPECT_EQ(models["communication"]["delay_s"], 0.2);
  EXPECT_EQ(models["reflectivity"], (json{{"Mirror", 0.9}}));
  ASSERT_EQ(models["sensors"].size(), 4u) << models;
  EXPECT_EQ(models["sensors"][0]["of"], "noisy");
  EXPECT_EQ(models["sensors"][0]["sensor"], "sonar");
  EXPECT_EQ(models["sensors"][0]["noise"], "polaroid");
  EXPECT_EQ(models["sensors"][0]["settings"]["dropout"], 0.05);
  EXPECT_EQ(models["sensors"][0]["settings"]["robot_crosstalk"], 0.02);
  EXPECT_EQ(models["sensors"][2]["settings"]["latency_s"], 0.2);
  EXPECT_EQ(models["sensors"][3]["settings"]["at"].size(), 2u);
}

TEST(Check, WarnsOfADefaultControllerThatLacksASensor) {
  const auto folder = emptyFolder();
  std::filesystem::create_directory(folder / "robots");
  std::ofstream(folder / "robots" / "scanner.xml") << R"(<robot name="scanner"><body radius_m="0.2" height_m="0.5"/>
<limits speed_max_mps="1" accel_mps2="1" decel_mps2="1" turn_max_degps="90" turn_accel_degps2="180"/>
<sensors><laser z_m="0.3" beams="360" field_of_view_deg="360" range_max_m="20"/><odometry/></sensors></robot>)";
  const auto world = folder / "world.xml";
  std::ofstream(world) << R"(<world><surface><size><xmin>-5</xmin><xmax>5</xmax><ymin>-5</ymin><ymax>5</ymax></size>
<object><shape><robot><model>scanner</model><name>R</name><x>0</x><y>0</y></robot></shape></object></surface></world>)";
  const Ended valid = runProgram("check " + quoted(world));
  EXPECT_EQ(valid.exit_code, 0) << valid.out;
  EXPECT_NE(valid.out.find("its controller gold_finder requires a sensor of kind heat"), std::string::npos)
      << valid.out;
  EXPECT_EQ(json::parse(runProgram("check --json " + quoted(world)).out)["warnings"].size(), 2u) << "and the open edge";
  EXPECT_EQ(runProgram("check --controller still " + quoted(world)).out.find("gold_finder"), std::string::npos);
  EXPECT_EQ(runProgram("check --controller gold_finder " + quoted(world)).exit_code, 1);
}

TEST(Check, ReadsARobotListOf2005) {
  const Ended check = runProgram("check tests/data/legacy_robots.xml");
  EXPECT_EQ(check.exit_code, 0) << check.out;
  EXPECT_NE(check.out.find("Finder2"), std::string::npos);
}

TEST(BenchGold, PrintsTheSameTableForAnyNumberOfThreads) {
  const auto folder = emptyFolder();
  const auto bench = [&](const std::string& threads) {
    return runProgram("bench gold worlds/small_maze.xml --runs 4 --seed 7 --threads " + threads + " --csv '" +
                      (folder / (threads + ".csv")).string() + "'");
  };
  const Ended one = bench("1");
  const Ended two = bench("2");
  EXPECT_EQ(one.exit_code, 0) << one.err;
  EXPECT_EQ(one.out, two.out);
  EXPECT_NE(one.out.find("100.0 %"), std::string::npos) << one.out;
  EXPECT_EQ(textOf(folder / "1.csv"), textOf(folder / "2.csv"));
  EXPECT_EQ(textOf(folder / "1.csv").substr(0, 22), "world,controller,seed,");
}

TEST(BenchMetrics, TabulatesMetricsOverControllersAndParameterValues) {
  const auto folder = emptyFolder();
  const Ended bench = runProgram(
      "bench metrics worlds/small_maze.xml --runs 2 --time 5 --observer coverage --controller still --controller "
      "'wall_follower distance_radii=1,2' --csv '" +
      (folder / "runs.csv").string() + "'");
  ASSERT_EQ(bench.exit_code, 0) << bench.err;
  for (const std::string text :
       {"coverage.covered_percent", " still ", "wall_follower distance_radii=1 ", "wall_follower distance_radii=2 "}) {
    EXPECT_NE(bench.out.find(text), std::string::npos) << text << "\n" << bench.out;
  }
  const std::string csv = textOf(folder / "runs.csv");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 3 * 2);
  EXPECT_EQ(countOf(",5.000,time_limit,,", csv), 3u * 2u) << csv;
  EXPECT_EQ(bench.out.find("found"), std::string::npos);  // which bench gold has

  EXPECT_EQ(runProgram("bench metrics worlds/small_maze.xml --runs 1").exit_code, 1);  // without an observer
}

TEST(BenchMetrics, CountsATimeThatRunsHaveNotReachedAsLater) {
  const auto folder = emptyFolder();
  // A robot that stands still covers no half of the maze; one that searches does so in some runs of 60 s.
  const Ended bench = runProgram(
      "bench metrics small_maze --runs 4 --time 60 --observer coverage --controller still --controller wander "
      "--csv " +
      quoted(folder / "runs.csv"));
  ASSERT_EQ(bench.exit_code, 0) << bench.err;
  std::istringstream lines(bench.out);
  std::string still, wander;
  for (std::string line; std::getline(lines, line);) {
    if (line.find("coverage.half_covered_s") == std::string::npos) continue;
    (line.find(" still ") != std::string::npos ? still : wander) = line;
  }
  EXPECT_EQ(countOf("later", still), 5u) << "quantiles and interval: " << still;
  EXPECT_NE(still.find("0 of 4"), std::string::npos) << still;
  EXPECT_NE(still.find("–"), std::string::npos) << "no mean: " << still;
  EXPECT_NE(bench.out.find("\"later\": the event has not happened within the runs."), std::string::npos) << bench.out;
}

TEST(BenchGold, PrintsTheCompletedRunsWhenInterrupted) {
  const auto folder = emptyFolder();
  StartedProgram bench({"bench", "gold", "worlds/small_maze.xml", "--runs", "1000000", "--threads", "2", "--csv",
                        (folder / "runs.csv").string()});
  bench.waitForFile(folder / "runs.csv.part");
  bench.interrupt();
  const Ended ended = bench.wait();
  EXPECT_EQ(ended.exit_code, 130);
  EXPECT_NE(ended.err.find("interrupted; the figures are of the "), std::string::npos) << ended.err;
  EXPECT_NE(ended.err.find(" of 1000000 runs that were completed"), std::string::npos) << ended.err;
  EXPECT_EQ(ended.out.substr(0, 6), "world ");
  EXPECT_EQ(textOf(folder / "runs.csv").substr(0, 22), "world,controller,seed,");
  EXPECT_FALSE(std::filesystem::exists(folder / "runs.csv.part"));
}

TEST(BenchGold, CountsOnlyTrueGold) {
  // A robot that reports gold is where its heat is measurable: within 1.5 m of it in this maze.
  RunOptions options;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    options.environment.seed = seed;
    LoadedWorld world = loadWorldToRun(ROBOSIM_SOURCE_DIR "/worlds/opho2_1.xml", "");
    shuffleStartPoses(world.world, world.fleet, seed);
    LocalRun run(std::move(world), options);
    while (!run.gold().all_halted_s && run.environment().time().seconds() < 1800) run.step();
    ASSERT_TRUE(run.gold().found_by) << "seed " << seed;
    const Environment& environment = run.environment();
    for (std::size_t i = 0; i < environment.robotCount(); ++i) {
      if (environment.state().activity[i] != Activity::found) continue;
      const auto& at = environment.state().world_from_robot[i];
      double nearest_m = 1e9;
      for (const auto& object : environment.world().objects) {
        if (object.body.heat_celsius == 0) continue;
        const auto& gold = object.body.world_from_body;
        nearest_m = std::min(nearest_m, std::hypot(at.x - gold.x, at.y - gold.y));
      }
      EXPECT_LT(nearest_m, 1.5) << "seed " << seed;
    }
  }
}

}  // namespace
}  // namespace robosim
