// `robosim run` on several ranks, started by mpirun.
#include <csignal>
#include <fstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/mpi/full_disk.h"
#include "tests/scenarios/program.h"

namespace robosim {
namespace {

/// Runs `robosim ARGUMENTS` on several ranks.
Ended runOnRanks(int ranks, const std::string& arguments) {
  return runCommand(ROBOSIM_MPIRUN " -n " + std::to_string(ranks) + " " ROBOSIM_PROGRAM " " + arguments);
}

/// With boxes, maps, cameras, and random robots; ./dev verify mpi runs all worlds.
std::vector<std::filesystem::path> shippedWorlds() {
  std::vector<std::filesystem::path> worlds;
  for (const char* name : {"opho2_1", "courtyard_and_office", "open_house", "scatter_swarm"}) {
    worlds.emplace_back(std::string(ROBOSIM_SOURCE_DIR "/worlds/") + name + ".xml");
  }
  return worlds;
}

/// The output of a run with all files, without what depends on the clock.
struct Outputs {
  std::string summary, rawlog, picture, csv;
  bool operator==(const Outputs&) const = default;
};

Outputs outputsOf(int ranks, const std::string& arguments, const std::filesystem::path& folder) {
  const std::string all = "run " + arguments + " --json --record " + quoted(folder / "r.rawlog") + " --picture " +
                          quoted(folder / "p.png") + " --csv " + quoted(folder / "t.csv");
  const Ended ended = ranks == 0 ? runProgram(all) : runOnRanks(ranks, all);
  EXPECT_EQ(ended.exit_code, 0) << arguments << ": " << ended.err;
  if (ended.exit_code != 0) return {};
  auto json = nlohmann::ordered_json::parse(ended.out);
  for (const char* of_the_clock : {"wall_s", "real_time_factor"}) json.erase(of_the_clock);
  return {json.dump(), textOf(folder / "r.rawlog"), textOf(folder / "p.png"), textOf(folder / "t.csv")};
}

/// @param folder for the files
void expectSameOnRanks(const std::string& arguments, const std::vector<int>& ranks,
                       const std::filesystem::path& folder) {
  const Outputs alone = outputsOf(0, arguments, folder);
  EXPECT_GT(alone.rawlog.size(), 1000u) << arguments;
  for (const int count : ranks) {
    const Outputs outputs =
        outputsOf(count, arguments + " --balance 3 --threads " + std::to_string(1 + count % 2), folder);
    EXPECT_EQ(outputs.summary, alone.summary) << arguments << ", " << count;
    EXPECT_TRUE(outputs == alone) << arguments << ", " << count;
  }
}

TEST(MpiRun, EqualsThatOfOneProcessInShippedWorlds) {
  const auto folder = emptyFolder();
  int ranks = 2;  // ./dev verify mpi runs each world on 1 to 8
  for (const auto& world : shippedWorlds()) {
    SCOPED_TRACE(world);
    expectSameOnRanks(quoted(world) + " --time 3", {ranks}, folder);
    ranks = 5 - ranks;
  }
}

/// Messages between ranks of all kinds (MAP, BID, TRAIL), and the map that `oracle` knows; ./dev verify mpi runs all
/// strategies.
TEST(MpiRun, EqualsThatOfOneProcessWithSearchStrategies) {
  const auto folder = emptyFolder();
  for (const std::string strategy : {"stigmergy", "coordinated_frontiers", "market", "oracle"}) {
    SCOPED_TRACE(strategy);
    expectSameOnRanks("worlds/benchmark/gold_office_20.xml --time 5 --controller " + strategy, {2}, folder);
  }
}

TEST(MpiRun, EqualsThatOfOneProcessInRandomWorlds) {
  const auto folder = emptyFolder();
  int seed = 1;  // ./dev verify mpi runs each kind on 1 to 8 ranks
  for (const std::string kind : {"maze", "cave", "office", "open"}) {
    const auto world = folder / (kind + ".xml");
    const Ended generated = runProgram("generate " + kind + " " + quoted(world) + " --seed " + std::to_string(seed));
    ASSERT_EQ(generated.exit_code, 0) << generated.err;
    const std::string options = " --random-robots 7 --noise on --random-starts --seed " + std::to_string(seed);
    expectSameOnRanks(quoted(world) + " --time 3" + options, {2 + seed++ % 2}, folder);
  }
}

TEST(MpiRun, WithAnObserverHasTheSameMetricsAndEnd) {
  expectSameOnRanks("worlds/open_100.xml --time 60 --controller wander --observer 'coverage end_percent=2'", {2},
                    emptyFolder());
}

TEST(MpiRun, PrintsTheSummaryOnce) {
  const Ended ended = runOnRanks(3, "run worlds/small_maze.xml --time 1");
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_EQ(countOf("digest", ended.out), 1u) << ended.out;
  EXPECT_EQ(ended.err, "");
}

TEST(MpiRun, ReportsInvalidArgumentsAndFilesOnce) {
  for (const std::string arguments : {"run no_such_world.xml", "run worlds/small_maze.xml --tme 3",
                                      "run worlds/small_maze.xml --controller no_such_controller",
                                      "run worlds/small_maze.xml --record /no_such_folder/r.rawlog",
                                      "run worlds/small_maze.xml --picture /no_such_folder/r.png"}) {
    const Ended ended = runOnRanks(2, arguments);
    const Ended alone = runProgram(arguments);
    EXPECT_EQ(ended.exit_code, 1) << arguments;
    EXPECT_EQ(alone.exit_code, 1) << arguments;
    EXPECT_EQ(countOf(alone.err.substr(0, alone.err.size() - 1), ended.err), 1u) << ended.err << alone.err;
    EXPECT_EQ(ended.out, "");
  }
}

TEST(MpiRun, EndsOnAllRanksWithTheErrorOfAController) {
  const Ended ended =
      runOnRanks(2, "run worlds/open_100.xml --controller failing_at_the_end --plugin " ROBOSIM_TEST_PLUGIN);
  EXPECT_EQ(ended.exit_code, 2);
  EXPECT_EQ(countOf("its controller failing_at_the_end threw an exception: lost the flock (on rank 1)", ended.err), 1u)
      << ended.err;
  EXPECT_EQ(countOf("robosim run: ", ended.err), 1u) << ended.err;
}

/// Until it fails, the sensor measures NaN, which the ranks exchange.
TEST(MpiRun, EndsOnAllRanksWithTheErrorOfASensorAndACompleteRecording) {
  const auto folder = emptyFolder();
  std::filesystem::create_directory(folder / "robots");
  std::ofstream(folder / "robots/failing.xml") << R"(<robot name="failing" help="Has a failing sensor.">
    <body radius_m="0.2" height_m="0.3"/>
    <limits speed_max_mps="1" accel_mps2="1" decel_mps2="2" turn_max_degps="100" turn_accel_degps2="200"/>
    <sensors><failing_sensor/><heat range_max_m="3"/><odometry/></sensors></robot>)";
  std::ofstream(folder / "failing.xml") << R"(<world><surface><size xmin="-5" xmax="5" ymin="-5" ymax="5"/>
    <scatter count="3"><robot model="failing" name="R" controller="random_walk"/></scatter></surface></world>)";
  const std::string run = "run " + quoted(folder / "failing.xml") + " --plugin " ROBOSIM_TEST_PLUGIN " --record ";
  const Ended alone = runProgram(run + quoted(folder / "alone.rawlog"));
  const Ended ended = runOnRanks(2, run + quoted(folder / "ranks.rawlog"));
  EXPECT_EQ(alone.exit_code, 2) << alone.err;
  EXPECT_EQ(ended.exit_code, 2) << ended.err;
  EXPECT_EQ(countOf("robosim run: lost the current", alone.err), 1u) << alone.err;
  EXPECT_EQ(countOf("robosim run: lost the current (on rank 1)", ended.err), 1u) << ended.err;
  EXPECT_EQ(countOf("robosim run: ", ended.err), 1u) << ended.err;
  EXPECT_GT(textOf(folder / "ranks.rawlog").size(), 100u);
  EXPECT_EQ(textOf(folder / "ranks.rawlog"), textOf(folder / "alone.rawlog"));
}

TEST(MpiRun, RefusesSubcommandsThatRunInOneProcess) {
  for (const std::string arguments : {"serve worlds/small_maze.xml", "view worlds/small_maze.xml",
                                      "run --view worlds/small_maze.xml", "check worlds/small_maze.xml"}) {
    const Ended ended = runOnRanks(2, arguments);
    EXPECT_EQ(ended.exit_code, 1) << arguments;
    EXPECT_EQ(countOf("runs in one process; start it without mpirun", ended.err), 1u) << ended.err;
  }
}

TEST(MpiRun, WithoutTheLibraryOfMpiIsRefused) {
  // All libraries but that one, as a build or an installation without MPI has.
  const auto folder = emptyFolder();
  for (const auto& entry : std::filesystem::directory_iterator(ROBOSIM_LIBRARIES)) {
    const auto name = entry.path().filename().string();
    if (name.starts_with("librobosim") && name.ends_with(".so." ROBOSIM_SOVERSION) &&
        !name.starts_with("librobosim-mpi"))
      std::filesystem::copy_file(entry.path(), folder / name);
  }
  const std::string alone =
      "LD_LIBRARY_PATH=" + quoted(folder) + " " ROBOSIM_PROGRAM " run worlds/small_maze.xml --time 1";
  EXPECT_EQ(runCommand(alone).exit_code, 0);
  for (const int rank : {0, 1}) {
    const Ended ended = runCommand("OMPI_COMM_WORLD_SIZE=2 OMPI_COMM_WORLD_RANK=" + std::to_string(rank) + " " + alone);
    EXPECT_EQ(ended.out, "");
    EXPECT_EQ(ended.exit_code, rank == 0 ? 1 : 0);
    const bool is_reported =
        ended.err.find("was started in 2 processes, but this installation has no MPI") != std::string::npos;
    EXPECT_EQ(is_reported, rank == 0) << ended.err;
  }
}

TEST(MpiRun, IsTheOnlyOneThatLoadsMpi) {
  const auto folder = std::filesystem::path(ROBOSIM_PROGRAM).parent_path();
  for (const char* program : {"robosim", "robosim-run", "robosim-net", "robosim-view"}) {
    const Ended ldd = runCommand("ldd " + quoted(folder / program));
    EXPECT_EQ(ldd.exit_code, 0) << ldd.err;
    EXPECT_EQ(ldd.out.find("libmpi."), std::string::npos) << program;
    EXPECT_EQ(ldd.out.find("robosim-mpi"), std::string::npos) << program;
  }
}

/// Starts a long run whose recording is not complete before it is ended.
std::vector<std::string> longRun(const std::filesystem::path& rawlog, int ranks) {
  const std::string world = ROBOSIM_SOURCE_DIR "/worlds/open_100.xml";
  return {"-n", std::to_string(ranks), ROBOSIM_PROGRAM, "run", world, "--speed", "1", "--record", rawlog};
}

TEST(MpiRun, InterruptedEndsAllRanksWithACompleteRecording) {
  const auto folder = emptyFolder();
  StartedProgram started(ROBOSIM_MPIRUN, longRun(folder / "r.rawlog", 2));
  started.waitForFileIn(folder);
  started.interrupt();
  const Ended ended = started.wait();
  EXPECT_NE(ended.exit_code, 0);
  EXPECT_NE(ended.out.find("interrupted"), std::string::npos) << ended.out << ended.err;
  const Ended replayed = runProgram("replay " + quoted(folder / "r.rawlog"));
  EXPECT_EQ(replayed.exit_code, 0) << replayed.err;
}

TEST(MpiRun, ThatLosesARankEndsWithoutAFileUnderTheFinalName) {
  const auto folder = emptyFolder();
  StartedProgram started(ROBOSIM_MPIRUN, longRun(folder / "r.rawlog", 3));
  started.waitForFileIn(folder);
  const std::string mpirun = std::to_string(started.process());
  int rank = 0;
  std::ifstream("/proc/" + mpirun + "/task/" + mpirun + "/children") >> rank;
  ASSERT_GT(rank, 0);
  ASSERT_EQ(kill(rank, SIGKILL), 0);
  const Ended ended = started.wait();
  EXPECT_NE(ended.exit_code, 0);
  EXPECT_FALSE(std::filesystem::exists(folder / "r.rawlog"));
}

TEST(MpiRun, ReportsAFullDiskOnce) {
  const auto folder = emptyFolder();
  const std::string run = "run worlds/open_100.xml --time 30 --record " + quoted(folder / "r.rawlog");
  const Ended ended = onFullDisk(2, run, 200);
  EXPECT_EQ(ended.exit_code, 2) << ended.err;
  EXPECT_EQ(countOf("robosim run: ", ended.err), 1u) << ended.err;
  EXPECT_EQ(countOf("File too large", ended.err), 1u) << ended.err;
  EXPECT_FALSE(std::filesystem::exists(folder / "r.rawlog")) << "it is not complete";
}

}  // namespace
}  // namespace robosim
