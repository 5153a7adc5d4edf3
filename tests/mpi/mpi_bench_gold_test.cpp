// `robosim bench gold` on several ranks, started by mpirun.
#include <algorithm>
#include <csignal>
#include <fstream>
#include <map>
#include <memory>
#include <thread>

#include <gtest/gtest.h>

#include "base/temporary_directory.h"
#include "tests/mpi/full_disk.h"
#include "tests/scenarios/program.h"
#include "tests/scenarios/verifying.h"

namespace robosim {
namespace {

namespace fs = std::filesystem;

/// 8 experiments of some runs each.
std::string benchOfTables(const fs::path& report) {
  return "bench gold worlds/small_maze.xml --controller random_walk --controller gold_finder --team 1,3 --condition "
         "ideal --condition noise+loss=0.5 --time 60 --runs " +
         std::string(isVerifying() ? "5" : "2") + " --report " + quoted(report);
}

Ended benchOnRanks(int ranks, const std::string& arguments) {
  return runCommand(ROBOSIM_MPIRUN " -n " + std::to_string(ranks) + " " ROBOSIM_PROGRAM " " + arguments);
}

/// The files of a report that must be the same however its runs are made.
std::map<std::string, std::string> reportOf(const fs::path& folder) {
  std::map<std::string, std::string> contents;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file() && entry.path().filename() != "journal.jsonl")
      contents[fs::relative(entry.path(), folder).string()] = textOf(entry.path());
  }
  return contents;
}

TEST(MpiBenchGold, WritesTheSameReportOnAnyNumberOfRanks) {
  const auto folder = emptyFolder();
  const Ended alone = runProgram(benchOfTables(folder / "1"));
  ASSERT_EQ(alone.exit_code, 0) << alone.err;
  for (const int ranks : {2, 3}) {
    const auto of_ranks = folder / std::to_string(ranks);
    const Ended ended = benchOnRanks(ranks, benchOfTables(of_ranks));
    ASSERT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_EQ(ended.out.substr(0, ended.out.find("\nreport")), alone.out.substr(0, alone.out.find("\nreport")))
        << "one rank prints";
    EXPECT_EQ(reportOf(of_ranks), reportOf(folder / "1"));
  }
}

/// Of each of the two controllers.
int runsPerController() { return isVerifying() ? 20 : 4; }

/// First runs of random_walk, then runs that wait for a signal where the environment has ROBOSIM_TEST_WAITS: how fast
/// mpirun forwards the signal, a second later, does not matter.
std::string benchThatWaits(const fs::path& report) {
  return "bench gold worlds/small_maze.xml --plugin " ROBOSIM_TEST_PLUGIN
         " --controller random_walk --controller waiting_walk --time 60 --runs " +
         std::to_string(runsPerController()) + " --report " + quoted(report);
}

/// The report of all its runs, made by one process once for all tests.
const std::map<std::string, std::string>& wholeReport() {
  static const auto report = [] {
    const TemporaryDirectory folder;
    const Ended alone = runProgram(benchThatWaits(folder.path()) + " --threads 2");
    EXPECT_EQ(alone.exit_code, 0) << alone.err;
    return reportOf(folder.path());
  }();
  return report;
}

int runsIn(const fs::path& journal) {
  const std::string text = textOf(journal);
  return static_cast<int>(std::count(text.begin(), text.end(), '\n')) - 1;  // the first line is the plan
}

/// Starts it on two ranks, each of which notes its process in a file pidRANK, and waits until a run is in the journal.
std::unique_ptr<StartedProgram> startThatWaits(const fs::path& folder, const fs::path& report) {
  fs::create_directories(report);
  auto mpirun = std::make_unique<StartedProgram>(
      ROBOSIM_MPIRUN,
      std::vector<std::string>{"-n", "2", "-x", "ROBOSIM_TEST_WAITS=1", "/bin/sh", "-c",
                               "echo $$ > " + quoted(folder / "pid") +
                                   "$OMPI_COMM_WORLD_RANK; exec '" ROBOSIM_PROGRAM "' " + benchThatWaits(report)});
  const auto journal = report / "journal.jsonl";
  mpirun->waitForFile(journal);
  while (mpirun->isRunning() && runsIn(journal) < 1) std::this_thread::yield();
  return mpirun;
}

/// Only runs that do not wait have ended, and the others complete the report.
void expectToBeCompleted(const fs::path& report) {
  const auto journal = report / "journal.jsonl";
  EXPECT_FALSE(fs::exists(report / "index.html"));
  EXPECT_GE(runsIn(journal), 1);
  EXPECT_LE(runsIn(journal), runsPerController());
  const std::string before = textOf(journal);
  const Ended resumed = benchOnRanks(3, benchThatWaits(report) + " --resume");
  ASSERT_EQ(resumed.exit_code, 0) << resumed.err;
  EXPECT_EQ(textOf(journal).substr(0, before.size()), before) << "no finished run is made again";
  EXPECT_EQ(reportOf(report), wholeReport());
}

TEST(MpiBenchGold, CompletesTheSameReportAfterAFailedRank) {
  const auto folder = emptyFolder(), report = folder / "killed";
  const auto mpirun = startThatWaits(folder, report);
  pid_t worker = 0;
  std::ifstream(folder / "pid1") >> worker;
  ASSERT_GT(worker, 1);
  ::kill(worker, SIGKILL);
  EXPECT_NE(mpirun->wait().exit_code, 0);
  expectToBeCompleted(report);
}

TEST(MpiBenchGold, CompletesTheSameReportAfterCtrlC) {
  const auto folder = emptyFolder(), report = folder / "interrupted";
  const auto mpirun = startThatWaits(folder, report);
  mpirun->interrupt();
  EXPECT_NE(mpirun->wait().exit_code, 0);
  expectToBeCompleted(report);
}

TEST(MpiBenchGold, ReportsAFullDiskOnceAndContinues) {
  const auto folder = emptyFolder();
  const std::string bench = "bench gold worlds/small_maze.xml --controller wander --runs 20 --time 20 --report ";
  const Ended alone = runProgram(bench + quoted(folder / "alone"));
  ASSERT_EQ(alone.exit_code, 0) << alone.err;
  const Ended full = onFullDisk(2, bench + quoted(folder / "full"), 4);
  EXPECT_EQ(full.exit_code, 2) << full.err;
  EXPECT_EQ(countOf("journal.jsonl: cannot be written", full.err), 1u) << full.err;
  EXPECT_EQ(countOf("robosim bench gold: ", full.err), 1u) << full.err;
  const Ended resumed = benchOnRanks(2, bench + quoted(folder / "full") + " --resume");
  ASSERT_EQ(resumed.exit_code, 0) << resumed.err;
  EXPECT_EQ(reportOf(folder / "full"), reportOf(folder / "alone"));
}

TEST(MpiBenchMetrics, TabulatesTheRunsOfOneProcess) {
  const auto folder = emptyFolder();
  const std::string bench =
      "bench metrics worlds/small_maze.xml --runs 5 --time 20 --observer coverage --controller wander --controller "
      "gold_finder --csv ";
  const Ended alone = runProgram(bench + quoted(folder / "alone.csv"));
  ASSERT_EQ(alone.exit_code, 0) << alone.err;
  const Ended ranks = benchOnRanks(3, bench + quoted(folder / "ranks.csv"));
  EXPECT_EQ(ranks.exit_code, 0) << ranks.err;
  EXPECT_EQ(ranks.out, alone.out);
  EXPECT_EQ(textOf(folder / "ranks.csv"), textOf(folder / "alone.csv"));
}

TEST(MpiBenchGold, RefusesOnAllRanksWithOneMessage) {
  const auto folder = emptyFolder();
  std::ofstream(folder / "file") << "x";
  const std::pair<std::string, std::string> wrong[] = {
      {"bench gold worlds/small_maze.xml --runs 2 --report " + quoted(folder / "file" / "r"), "cannot be created"},
      {"bench gold worlds/small_maze.xml --runs 2 --threads 2", "start more processes instead"},
      {"bench metrics worlds/small_maze.xml --runs 2 --observer coverage --csv " + quoted(folder / "file" / "r"),
       "cannot be created"},
      {"bench gold worlds/missing.xml", "worlds/missing.xml"}};
  for (const auto& [arguments, text] : wrong) {
    const Ended ended = benchOnRanks(3, arguments);
    EXPECT_NE(ended.exit_code, 0) << arguments;
    const std::size_t first = ended.err.find(text);
    EXPECT_NE(first, std::string::npos) << arguments << "\n" << ended.err;
    EXPECT_EQ(ended.err.find(text, first + 1), std::string::npos) << ended.err;
  }
}

}  // namespace
}  // namespace robosim
