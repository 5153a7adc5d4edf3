// `robosim_bench speed` with text and with JSON output.
#include <filesystem>
#include <set>
#include <sstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "robosim_bench/ray_caster.h"
#include "tests/scenarios/benchmark.h"

namespace robosim {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

std::vector<ordered_json> jsonLines(const Ended& bench) {
  std::vector<ordered_json> lines;
  std::istringstream in(bench.out);
  for (std::string line; std::getline(in, line);) lines.push_back(ordered_json::parse(line));
  return lines;
}

TEST(BenchSpeed, PrintsOneJsonObjectPerLineWithCommonFieldsFirst) {
  const Ended bench = runBenchmark("speed --robots 5 --robots 20 --min-time 1e-6 --json");
  ASSERT_EQ(bench.exit_code, 0) << bench.err;
  const auto lines = jsonLines(bench);
  const bool beside_enki = fs::exists(fs::path(ROBOSIM_BENCH).parent_path() / "robosim_enki");
  ASSERT_EQ(lines.size(), beside_enki ? 14 : 12)
      << "four workloads in two sizes, four ways to cast rays, and two sizes beside Enki";
  std::set<std::string> workloads;
  for (const auto& line : lines) {
    std::vector<std::string> names;
    for (const auto& field : line.items()) names.push_back(field.key());
    names.resize(7);
    EXPECT_EQ(names, (std::vector<std::string>{"workload", "robots", "threads", "robot_steps_per_s", "rays_per_s",
                                               "cpu_s_per_robot_step", "peak_rss_mb"}));
    workloads.insert(line["workload"].get<std::string>());
    EXPECT_TRUE(line["robots"].is_number_unsigned()) << line;
    EXPECT_TRUE(line["threads"].is_number_integer()) << line;
    for (const char* figure : {"robot_steps_per_s", "cpu_s_per_robot_step", "peak_rss_mb"}) {
      ASSERT_TRUE(line[figure].is_number_float()) << line;
      EXPECT_GT(line[figure].get<double>(), 0) << line;
    }
    EXPECT_TRUE(line["rays_per_s"].is_number_float()) << line;
    EXPECT_EQ(line["rays_per_s"].get<double>() > 0, line["workload"] != "sector" && line["workload"] != "enki")
        << "sectors are not a number of rays, and Enki's rays are not RoboSim's";
  }
  workloads.erase("enki");
  EXPECT_EQ(workloads, (std::set<std::string>{"sonar", "sector", "laser", "infrared", "rays"}));
}

TEST(BenchSpeed, IsIdenticalForAnyNumberOfThreads) {
  const auto digests = [](int threads) {
    const Ended bench = runBenchmark(
        "speed --workload sonar --workload sector --workload laser --workload infrared --robots 300 "
        "--min-time 1e-6 --json --threads " +
        std::to_string(threads));
    EXPECT_EQ(bench.exit_code, 0) << bench.err;
    std::vector<std::string> all;
    for (const auto& line : jsonLines(bench)) {
      EXPECT_EQ(line["threads"], threads);
      all.push_back(line["digest"].get<std::string>());
    }
    return all;
  };
  const auto one = digests(1);
  EXPECT_EQ(one.size(), 4);
  EXPECT_EQ(std::set<std::string>(one.begin(), one.end()).size(), 4) << "four workloads, four runs";
  EXPECT_EQ(one, digests(2));
  EXPECT_EQ(one, digests(3));
}

TEST(BenchSpeed, CreatesDifferentWorldsForDifferentSeeds) {
  const auto digest = [](const std::string& seed) {
    return jsonLines(runBenchmark("speed --workload sonar --robots 20 --min-time 1e-6 --json --seed " + seed))
        .at(0)["digest"];
  };
  EXPECT_EQ(digest("1"), digest("1"));
  EXPECT_NE(digest("1"), digest("2"));
}

TEST(BenchSpeed, MeasuresRobotTypesInPlaceOfWorkloads) {
  const std::string arguments = "speed --robots 4 --min-time 1e-6 --json --robot-type ";
  const auto lines = jsonLines(runBenchmark(arguments + "scout --robot-type p3at"));
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(lines[0]["workload"], "scout");
  EXPECT_EQ(lines[1]["workload"], "p3at") << "robots of 0.4 m radius start without touching";
  EXPECT_EQ(lines[0]["rays_per_s"], 0) << "beams of several sensors are not counted";
  EXPECT_NE(lines[0]["digest"], lines[1]["digest"]);

  const auto all = jsonLines(runBenchmark(arguments + "all"));
  const auto files = fs::directory_iterator(ROBOSIM_SOURCE_DIR "/worlds/robots");
  EXPECT_EQ(static_cast<std::ptrdiff_t>(all.size()), std::distance(begin(files), end(files)));

  const Ended unknown = runBenchmark(arguments + "scuot");
  EXPECT_EQ(unknown.exit_code, 1);
  EXPECT_NE(unknown.err.find("scuot"), std::string::npos) << unknown.err;
}

TEST(BenchSpeed, PrintsATextTable) {
  const Ended bench = runBenchmark("speed --workload laser --robots 20 --min-time 1e-6");
  EXPECT_EQ(bench.exit_code, 0) << bench.err;
  EXPECT_EQ(bench.out.rfind("workload  robots  threads  robot-steps/s", 0), 0) << bench.out;
  EXPECT_NE(bench.out.find("\nlaser         20        1"), std::string::npos) << bench.out;
  EXPECT_EQ(bench.out.find("target"), std::string::npos) << "only asked for a part\n" << bench.out;
  EXPECT_NE(bench.out.find("Other programs used"), std::string::npos) << bench.out;
}

TEST(BenchSpeed, ComparesRaysWithEmbreeAndReportsIfItIsMissing) {
  const fs::path program = ROBOSIM_BENCH;
  const std::string arguments = "speed --workload rays --min-time 1e-6";

  // The module is in the program's folder; a copy of the program elsewhere has none.
  const auto folder = emptyFolder();
  fs::copy_file(program, folder / "robosim");
  const Ended alone = runCommand("'" + (folder / "robosim").string() + "' " + arguments);
  EXPECT_EQ(alone.exit_code, 0) << alone.err;
  EXPECT_NE(alone.out.find("Not compared with Embree 3: RoboSim was built without Embree; install libembree-dev"),
            std::string::npos)
      << alone.out;
  EXPECT_NE(alone.out.find("181,000 results equal brute force."), std::string::npos) << alone.out;

  if (!fs::exists(program.parent_path() / kEmbreeModule)) return;  // only `alone` can be tested then
  const Ended beside = runBenchmark(arguments);
  EXPECT_EQ(beside.exit_code, 0) << beside.err;
  EXPECT_NE(beside.out.find("Embree 3."), std::string::npos) << beside.out;
  EXPECT_NE(beside.out.find("181,000 results of each equal brute force."), std::string::npos) << beside.out;
}

TEST(BenchSpeed, ComparesInfraredRobotsWithEnkiAndReportsIfItIsMissing) {
  const fs::path program = ROBOSIM_BENCH;
  const std::string arguments = "speed --workload enki --robots 30 --robots 2000 --min-time 1e-6";
  const auto folder = emptyFolder();
  fs::copy_file(program, folder / "robosim");
  const Ended alone = runCommand("'" + (folder / "robosim").string() + "' " + arguments);
  EXPECT_EQ(alone.exit_code, 0) << alone.err;
  EXPECT_EQ(
      alone.out.rfind("Not compared with Enki: RoboSim was built without Enki; install libenki-dev and rebuild.", 0), 0)
      << alone.out;

  if (!fs::exists(program.parent_path() / "robosim_enki")) return;  // only `alone` can be tested then
  const Ended beside = runBenchmark(arguments);
  EXPECT_EQ(beside.exit_code, 0) << beside.err;
  EXPECT_NE(beside.out.find("\n30 robots"), std::string::npos) << beside.out;
  EXPECT_EQ(beside.out.find("2,000 robots"), std::string::npos) << "too many for Enki\n" << beside.out;
}

TEST(BenchSpeed, RunsWithoutEmbree) {
  const Ended libraries = runCommand("ldd '" ROBOSIM_BENCH "'");
  EXPECT_EQ(libraries.exit_code, 0) << libraries.err;
  EXPECT_NE(libraries.out.find("libtbb"), std::string::npos) << libraries.out;
  EXPECT_EQ(libraries.out.find("embree"), std::string::npos) << libraries.out;
}

TEST(BenchSpeed, EndsOnInterrupt) {
  // Enough loads for half a minute.
  std::vector<std::string> arguments{"speed", "--json", "--workload", "sonar"};
  for (int i = 0; i < 1000; ++i) arguments.insert(arguments.end(), {"--robots", "10"});
  StartedProgram bench(ROBOSIM_BENCH, arguments);
  bench.waitForOutput("\n");
  bench.interrupt();
  const Ended ended = bench.wait();
  EXPECT_EQ(ended.exit_code, 130);
  EXPECT_EQ(ended.err, "robosim_bench speed: interrupted before all was measured\n");
  for (const auto& line : jsonLines(ended)) EXPECT_EQ(line["robots"], 10) << "no half line";
}

TEST(BenchSpeed, RejectsInvalidArguments) {
  const std::pair<const char*, const char*> wrong[] = {
      {"--workload radar", "--workload: radar not in {sonar,sector,laser,infrared,rays,enki}"},
      {"--robots 0", "--robots: 0: must be a whole number from 1 to 10000000"},
      {"--robots -5", "--robots: -5: must be a whole number from 1"},
      {"--robots many", "--robots: many: must be a whole number from 1"},
      {"--threads 0", "--threads: 0: must be a whole number from 1 to 1024"},
      {"--min-time 0", "--min-time: 0: must be a number in [1e-06, 3600]"},
      {"--min-time nan", "--min-time: nan: must be a number"},
      {"--seed -1", "--seed: -1: must be a whole number"},
      {"sonar", "unexpected argument 'sonar'"},
  };
  for (const auto& [arguments, message] : wrong) {
    const Ended bench = runBenchmark(std::string("speed ") + arguments);
    EXPECT_EQ(bench.exit_code, 1) << arguments;
    EXPECT_EQ(bench.out, "") << arguments;
    EXPECT_NE(bench.err.find(message), std::string::npos) << arguments << ": " << bench.err;
  }
}

}  // namespace
}  // namespace robosim
