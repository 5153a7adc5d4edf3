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
  const auto runs = nlohmann::json::parse(textOf(folder / "first" / "runs.json"));
  std::string command = runs["command"];
  ASSERT_EQ(command.substr(0, 19), "robosim bench gold ");
  const std::size_t at = command.find("FOLDER");
  ASSERT_NE(at, std::string::npos);
  command.replace(at, 6, quoted(folder / "second"));
  const Ended second = runProgram(command.substr(8));
  ASSERT_EQ(second.exit_code, 0) << second.err;
  EXPECT_EQ(reportOf(folder / "first"), reportOf(folder / "second"));
}

TEST(GoldReport, StatesTheVersion) {
  const auto folder = emptyFolder();
  const Ended bench = runProgram("bench gold worlds/small_maze.xml --runs 1 --time 1 --report " + quoted(folder / "r"));
  ASSERT_EQ(bench.exit_code, 0) << bench.err;
  const Ended version = runProgram("--version");
  std::string number = version.out.substr(version.out.find_first_of("0123456789"));
  number = number.substr(0, number.find_first_not_of("0123456789."));
  EXPECT_EQ(nlohmann::json::parse(textOf(folder / "r" / "runs.json"))["robosim_version"], number);
  EXPECT_NE(textOf(folder / "r" / "index.html").find("RoboSim " + number + "."), std::string::npos);
}

TEST(GoldReport, ReproducesRobotsWithAnyHeading) {
  // 69° and 138° in radians are not exactly the same degrees again.
  const auto folder = emptyFolder();
  const std::string robots = "--robot pioneer3dx@1,2,69 --robot pioneer3dx@1,1,138";
  const Ended bench =
      runProgram("bench gold worlds/small_maze.xml " + robots + " --runs 1 --time 1 --report " + quoted(folder / "r"));
  ASSERT_EQ(bench.exit_code, 0) << bench.err;
  const std::string command = nlohmann::json::parse(textOf(folder / "r" / "runs.json"))["command"];
  EXPECT_NE(command.find(" " + robots + " "), std::string::npos) << command;
}

TEST(GoldReport, IsTheSameAfterAFullDisk) {
  const auto folder = emptyFolder();
  const std::string bench = "bench gold worlds/small_maze.xml --controller wander --runs 12 --time 20 --report ";
  const Ended whole = runProgram(bench + quoted(folder / "whole"));
  ASSERT_EQ(whole.exit_code, 0) << whole.err;
  const auto files_of = [&](const std::string& blocks) {
    // In blocks of 512 bytes.
    return runCommand("trap '' XFSZ; ulimit -f " + blocks + "; '" ROBOSIM_PROGRAM "' " + bench +
                      quoted(folder / "full") + " --resume");
  };
  // The disk is full after some runs, and then when the report is written.
  const Ended journal = files_of("4");
  EXPECT_EQ(journal.exit_code, 2);
  EXPECT_EQ(countOf("robosim bench gold: ", journal.err), 1u) << journal.err;
  EXPECT_NE(journal.err.find("journal.jsonl: cannot be written"), std::string::npos) << journal.err;
  EXPECT_NE(journal.err.find("free disk space, and add --resume"), std::string::npos) << journal.err;
  const std::string runs = textOf(folder / "full" / "journal.jsonl");
  EXPECT_GT(std::count(runs.begin(), runs.end(), '\n'), 1) << "the plan and some runs";
  EXPECT_TRUE(runs.ends_with("}\n")) << "complete lines only";
  const Ended report = files_of("12");
  EXPECT_EQ(report.exit_code, 2);
  EXPECT_EQ(countOf("robosim bench gold: ", report.err), 1u) << report.err;
  EXPECT_NE(report.err.find("cannot be written (File too large)"), std::string::npos) << report.err;
  EXPECT_FALSE(fs::exists(folder / "full" / "index.html"));
  const Ended resumed = runProgram(bench + quoted(folder / "full") + " --resume");
  ASSERT_EQ(resumed.exit_code, 0) << resumed.err;
  EXPECT_EQ(reportOf(folder / "full"), reportOf(folder / "whole"));
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
  const std::vector<std::string> arguments{"bench", "gold", "worlds/small_maze.xml", "--runs", "400", "--report"};
  std::string bench;
  for (const auto& word : arguments) bench += word + " ";
  const Ended alone = runProgram(bench + quoted(folder / "alone") + " --threads 2");
  ASSERT_EQ(alone.exit_code, 0) << alone.err;
  fs::create_directories(folder / "report");
  std::vector<std::string> of_interrupted = arguments;
  of_interrupted.push_back((folder / "report").string());
  StartedProgram interrupted(of_interrupted);
  const auto journal = folder / "report" / "journal.jsonl";
  interrupted.waitForFile(journal);
  // Until some runs are in the journal.
  while (interrupted.isRunning() && textOf(journal).size() < 3000) {
  }
  interrupted.interrupt();
  const Ended ended = interrupted.wait();
  EXPECT_EQ(ended.exit_code, 130);
  EXPECT_NE(ended.err.find("--resume makes the others"), std::string::npos) << ended.err;
  EXPECT_FALSE(fs::exists(folder / "report" / "index.html"));
  const std::string before = textOf(journal);
  const Ended resumed = runProgram(bench + quoted(folder / "report") + " --resume");
  ASSERT_EQ(resumed.exit_code, 0) << resumed.err;
  EXPECT_EQ(textOf(journal).substr(0, before.size()), before);
  EXPECT_EQ(reportOf(folder / "report"), reportOf(folder / "alone"));
}

TEST(GoldReport, IsWrittenAndContinuedByTheScriptForSlurm) {
  const auto folder = emptyFolder();
  // In place of srun: fewer and shorter runs, in one process.
  std::ofstream(folder / "srun") << "#!/bin/sh\nshift 2\n"
                                    "exec '" ROBOSIM_PROGRAM
                                    "' $(echo \"$@\" | sed 's/--runs 100/--runs 1 --time 1/')\n";
  fs::permissions(folder / "srun", fs::perms::owner_all);
  const std::string script = "PATH=" + quoted(folder) + ":$PATH doc/examples/slurm_bench_gold.sh ";
  const Ended begun = runCommand(script + quoted(folder / "report"));
  ASSERT_EQ(begun.exit_code, 0) << begun.err;
  const auto report = contentsOf(folder / "report");
  EXPECT_TRUE(report.contains("index.html"));
  const Ended continued = runCommand(script + quoted(folder / "report"));
  EXPECT_EQ(continued.exit_code, 0) << continued.err;
  EXPECT_EQ(contentsOf(folder / "report"), report);
  EXPECT_NE(runCommand(script).exit_code, 0) << "without a folder";
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
      {"worlds/small_maze.xml --resume", "--resume: has no effect without --report"},
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
