// Reports of `robosim bench gold` from the command line.
#include <algorithm>
#include <fstream>
#include <map>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/scenarios/program.h"

namespace robosim {
namespace {

namespace fs = std::filesystem;

const std::string kBench =
    "bench gold worlds/small_maze.xml --controller wander --controller gold_finder --team 1,3 --condition ideal "
    "--condition noise+loss=0.5+breakdown_s=20 --runs 3 --time 60 --report ";

/// All files of a folder, by path.
std::map<std::string, std::string> contentsOf(const fs::path& folder) {
  std::map<std::string, std::string> contents;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    contents[fs::relative(entry.path(), folder).string()] = textOf(entry.path());
  }
  return contents;
}

/// Those that must not depend on the order in which runs end.
std::map<std::string, std::string> reportOf(const fs::path& folder) {
  auto contents = contentsOf(folder);
  contents.erase("journal.jsonl");
  return contents;
}

TEST(GoldReport, DoesNotDependOnTheNumberOfThreads) {
  const auto folder = emptyFolder();
  for (const std::string threads : {"1", "3"}) {
    const Ended bench = runProgram(kBench + quoted(folder / threads) + " --threads " + threads);
    ASSERT_EQ(bench.exit_code, 0) << bench.err;
    EXPECT_NE(bench.out.find("\nreport  "), std::string::npos) << bench.out;
  }
  const auto one = reportOf(folder / "1");
  EXPECT_EQ(one, reportOf(folder / "3"));
  for (const std::string file :
       {"index.html", "runs.csv", "runs.json", "comparisons.csv", "figures/survival_small_maze_1_robot_ideal.svg",
        "figures/survival_small_maze_3_robots_noise_loss_0.5_breakdown_s_20.pdf",
        "figures/speed_up_small_maze_ideal.svg"}) {
    EXPECT_TRUE(one.contains(file)) << file;
  }
  EXPECT_EQ(std::count(one.at("runs.csv").begin(), one.at("runs.csv").end(), '\n'), 1 + 2 * 2 * 2 * 3);
  EXPECT_EQ(one.at("index.html").find("src="), std::string::npos) << "everything is in the page";
}

TEST(GoldReport, ContainsTheCommandThatReproducesIt) {
  const auto folder = emptyFolder();
  const Ended first = runProgram(kBench + quoted(folder / "first"));
  ASSERT_EQ(first.exit_code, 0) << first.err;
  const auto json = nlohmann::json::parse(textOf(folder / "first" / "runs.json"));
  std::string command = json["command"];
  ASSERT_EQ(command.substr(0, 19), "robosim bench gold ");
  const std::size_t at = command.find("FOLDER");
  ASSERT_NE(at, std::string::npos);
  command.replace(at, 6, quoted(folder / "second"));
  const Ended second = runProgram(command.substr(8));
  ASSERT_EQ(second.exit_code, 0) << second.err;
  EXPECT_EQ(reportOf(folder / "first"), reportOf(folder / "second"));
}

TEST(GoldReport, IsTheSameAfterAnInterruption) {
  const auto folder = emptyFolder();
  const Ended whole = runProgram(kBench + quoted(folder / "whole"));
  ASSERT_EQ(whole.exit_code, 0) << whole.err;
  // As if the program had been killed while it wrote its tenth run.
  const std::string journal = textOf(folder / "whole" / "journal.jsonl");
  std::size_t end = 0;
  for (int line = 0; line < 10; ++line) end = journal.find('\n', end) + 1;
  fs::create_directories(folder / "killed");
  std::ofstream(folder / "killed" / "journal.jsonl") << journal.substr(0, end + 30);
  const Ended refused = runProgram(kBench + quoted(folder / "killed"));
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_NE(refused.err.find("add --resume"), std::string::npos) << refused.err;
  const Ended resumed = runProgram(kBench + quoted(folder / "killed") + " --resume");
  ASSERT_EQ(resumed.exit_code, 0) << resumed.err;
  EXPECT_EQ(resumed.out.substr(0, resumed.out.find("\nreport")), whole.out.substr(0, whole.out.find("\nreport")));
  EXPECT_EQ(reportOf(folder / "killed"), reportOf(folder / "whole"));
  EXPECT_EQ(textOf(folder / "killed" / "journal.jsonl").substr(0, end), journal.substr(0, end));
}

TEST(GoldReport, ContinuesAfterCtrlC) {
  const auto folder = emptyFolder();
  const std::vector<std::string> arguments{"bench",  "gold",     "worlds/small_maze.xml",
                                           "--runs", "1000000",  "--time",
                                           "5",      "--report", (folder / "report").string()};
  fs::create_directories(folder / "report");
  StartedProgram bench(arguments);
  bench.waitForFile(folder / "report" / "journal.jsonl");
  bench.interrupt();
  const Ended ended = bench.wait();
  EXPECT_EQ(ended.exit_code, 130);
  EXPECT_NE(ended.err.find("--resume makes the others"), std::string::npos) << ended.err;
  EXPECT_FALSE(fs::exists(folder / "report" / "index.html"));
}

TEST(GoldReport, RefusesWhatMakesNoSense) {
  const auto folder = emptyFolder();
  const std::string report = " --report " + quoted(folder / "r");
  const std::pair<std::string, std::string> wrong[] = {
      {"worlds/small_maze.xml --team 0" + report, "--team"},
      {"worlds/small_maze.xml --team 2,2" + report, "a size of --team is given twice"},
      {"worlds/small_maze.xml --condition windy" + report, "'windy' is not known"},
      {"worlds/small_maze.xml --condition ideal --condition ideal" + report, "a --condition is given twice"},
      {"worlds/small_maze.xml --controller wander --controller wander" + report, "a controller is given twice"},
      {"worlds/small_maze.xml worlds/small_maze.xml" + report, "two worlds named 'small_maze'"},
      {"worlds/small_maze.xml --resume", "--resume continues a --report"},
      {"worlds/small_maze.xml --observer effort", "bench gold always has it"},
      {"worlds/small_maze.xml --team 10000" + report, "use a smaller team"}};
  for (const auto& [arguments, text] : wrong) {
    const Ended ended = runProgram("bench gold " + arguments);
    EXPECT_EQ(ended.exit_code, 1) << arguments;
    EXPECT_NE(ended.err.find(text), std::string::npos) << arguments << "\n" << ended.err;
  }
  EXPECT_FALSE(fs::exists(folder / "r"));
}

TEST(GoldReport, NeedsAFolderThatCanBeWritten) {
  const auto folder = emptyFolder();
  std::ofstream(folder / "file") << "x";
  const Ended ended = runProgram("bench gold worlds/small_maze.xml --runs 1 --report " + quoted(folder / "file" / "r"));
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_NE(ended.err.find("cannot be created"), std::string::npos) << ended.err;
}

}  // namespace
}  // namespace robosim
