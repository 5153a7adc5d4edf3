// Robots, starts and noise from the command line; output of `check`, `export` and `bench gold` on worlds and maps.
#include <fstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/scenarios/recorded_run.h"
#include "viewing/view_source.h"

namespace robosim {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

json run(const std::string& arguments) {
  const Ended ended = runProgram("run --json " + arguments);
  EXPECT_EQ(ended.exit_code, 0) << arguments << "\n" << ended.err;
  return json::parse(ended.out, nullptr, false);
}

fs::path write(const std::string& name, const std::string& text) {
  const fs::path file = emptyFolder() / name;
  std::ofstream(file) << text;
  return file;
}

std::string quotedBetweenSpaces(const fs::path& file) { return " '" + file.string() + "' "; }

TEST(WorldChanges, AllowRunningAMapWithoutAWorldFile) {
  const json added = run(
      "maps/lab.yaml --robot pioneer3dx@2,2,90 --robot scout@4,2 --random-robots 3,scout --controller wander --time 5");
  EXPECT_EQ(added["robots"], 5);
  EXPECT_EQ(added["steps"], 50);
  EXPECT_EQ(run("maps/office.map --controller wander --time 1")["robots"], 1) << "the one at the map's home";
  EXPECT_EQ(run("maps/office.map --random-robots 2 --controller wander --time 1")["robots"], 2);
}

TEST(WorldChanges, ShowTheRandomRobotsOfTheSeed) {
  WorldChanges changes;
  changes.random_robots = 3;
  const auto poses_of = [&](std::uint64_t seed) {
    std::vector<mrpt::math::TPose2D> poses;
    const auto view = openView(ROBOSIM_SOURCE_DIR "/maps/lab.yaml", {}, changes, seed);
    for (const auto& robot : view->snapshot().robots) poses.push_back(robot.world_from_robot);
    return poses;
  };
  EXPECT_EQ(poses_of(7).size(), 3u);
  EXPECT_EQ(poses_of(7), poses_of(7));
  EXPECT_NE(poses_of(7), poses_of(8));
  EXPECT_NE(runProgram("view --help").out.find("--seed"), std::string::npos);
}

TEST(WorldChanges, RejectARobotInsideAWall) {
  const std::string error = refusalOf("run maps/lab.yaml --robot scout@0,0");
  EXPECT_NE(error.find("maps/lab.yaml: robot 'Robot1' at (0, 0) m overlaps an obstacle of the map 'lab.yaml'"),
            std::string::npos)
      << error;
  EXPECT_NE(refusalOf("run maps/lab.yaml --robot scout").find("must be TYPE@X,Y or TYPE@X,Y,HEADING"),
            std::string::npos);
  EXPECT_NE(refusalOf("run maps/lab.yaml --random-robots many").find("must be a whole number from 1 to 100000"),
            std::string::npos);
  EXPECT_NE(refusalOf("view tests/data/none.rawlog --robot scout@0,0").find("none.rawlog"), std::string::npos);
}

TEST(WorldChanges, AreStoredInARecording) {
  const fs::path rawlog = emptyFolder() / "run.rawlog";
  const json made = run("maps/lab.yaml --random-robots 2 --noise on --controller wander --time 3 --seed 5 --record" +
                        quotedBetweenSpaces(rawlog));
  const json replayed = json::parse(runProgram("replay --json" + quotedBetweenSpaces(rawlog)).out, nullptr, false);
  EXPECT_EQ(replayed["run"]["outcome"]["digest"], made["digest"]);
  EXPECT_EQ(runProgram("replay" + quotedBetweenSpaces(rawlog) + "--controller wander").exit_code, 0)
      << "its world can be read again";
}

TEST(Seed, WithoutEffectIsReported) {
  const json one = run("worlds/maze_20x20.xml --time 20 --seed 1"),
             other = run("worlds/maze_20x20.xml --time 20 --seed 7");
  EXPECT_EQ(one["digest"], other["digest"]);
  EXPECT_EQ(one["depends_on_seed"], false);
  const Ended text = runProgram("run worlds/maze_20x20.xml --time 20 --seed 7");
  EXPECT_NE(text.out.find("7 (without effect: nothing in this run was random"), std::string::npos) << text.out;
}

TEST(Seed, ChangesRunsWithRandomStartsOrNoise) {
  for (const std::string option : {"--random-starts", "--noise on"}) {
    const auto seeded = [&](const std::string& seed) {
      return run("worlds/maze_20x20.xml --time 20 " + option + " --seed " + seed);
    };
    EXPECT_NE(seeded("1")["digest"], seeded("7")["digest"]) << option;
    EXPECT_EQ(seeded("7")["digest"], seeded("7")["digest"]) << option;
    EXPECT_EQ(seeded("1")["depends_on_seed"], true) << option;
  }
}

TEST(Step, WarnsIfItDoesNotDivideTheTime) {
  const Ended ended = runProgram("run worlds/small_maze.xml --step 0.3 --time 1 --json");
  EXPECT_EQ(ended.exit_code, 0);
  EXPECT_EQ(json::parse(ended.out)["steps"], 3);
  EXPECT_NE(
      ended.err.find("--time 1 is not a multiple of the time step of 0.3 s: a run ends after 0.9 s at the latest"),
      std::string::npos)
      << ended.err;
  EXPECT_EQ(runProgram("run worlds/small_maze.xml --step 0.3 --time 0.9").err, "");
}

TEST(Check, ReportsRobotPosesAndWallLength) {
  const Ended office = runProgram("check maps/office.map");
  EXPECT_EQ(office.exit_code, 0);
  EXPECT_NE(office.out.find(" m, heading "), std::string::npos) << office.out;
  EXPECT_NE(office.out.find("start 1 of "), std::string::npos) << office.out;
  EXPECT_NE(office.out.find("walls"), std::string::npos) << office.out;
}

TEST(Check, WarnsOfAnOpenEdgeWithItsLength) {
  // On 4 m × 4 m a Scout of 0.19 m radius can reach 3.62 m of each side with its centre.
  const fs::path file = write("open.xml",
                              "<world><surface><size><xmin>-2</xmin><xmax>2</xmax><ymin>-2</ymin><ymax>2</ymax></size>"
                              "<object><shape><robot><model>scout</model><name>A</name><x>0</x><y>0</y></robot></shape>"
                              "</object></surface></world>");
  const Ended check = runProgram("check" + quotedBetweenSpaces(file));
  EXPECT_EQ(check.exit_code, 0) << "a warning is no error";
  EXPECT_NE(check.out.find("warning: " + file.string() + ": robots can reach "), std::string::npos) << check.out;
  const json result = json::parse(runProgram("check --json" + quotedBetweenSpaces(file)).out);
  EXPECT_NEAR(result["open_edge_m"].get<double>(), 4 * 3.62, 4 * 0.2);
  EXPECT_EQ(result["warnings"].size(), 1u);
  EXPECT_EQ(result["ok"], true);
}

TEST(Check, DoesNotWarnOfEdgesInShippedWorlds) {
  for (const auto& entry : fs::directory_iterator(ROBOSIM_SOURCE_DIR "/worlds")) {
    if (entry.path().extension() != ".xml") continue;
    const json result = json::parse(runProgram("check --json" + quotedBetweenSpaces(entry.path())).out);
    EXPECT_EQ(result["warnings"], json::array()) << entry.path();
  }
}

/// A room of 4 m × 3 m as ActivMedia's map, with these homes: "X Y HEADING" in millimetres and degrees.
fs::path roomWithHomes(const std::string& name, const std::vector<std::string>& homes) {
  std::string text = "2D-Map\n";
  for (const auto& home : homes) text += "Cairn: RobotHome " + home + " \"\" ICON \"h\"\n";
  return write(name, text + "LINES\n0 0 4000 0\n4000 0 4000 3000\n4000 3000 0 3000\n0 3000 0 0\nDATA\n");
}

TEST(Placement, MovesTheRobotOfAMapFromABlockedHomeInAllCommands) {
  // 0.1 m from the walls, nearer than the Pioneer's radius of 0.267 m: places lie in the
  // middle of cells of half of it, of which the third, at 2.5 × 0.133 m, is the first that the disc fits at.
  const fs::path map = roomWithHomes("one.map", {"100 100 90"});
  const std::string warning = map.string() + ": robot 'Robot1' stands at (0.333, 0.333) m, the nearest free place: ";
  const fs::path out = map.parent_path() / "out.svg";
  for (const std::string& command : {"run --time 1 --controller wander" + quotedBetweenSpaces(map),
                                     "view --offscreen" + quotedBetweenSpaces(out) + quotedBetweenSpaces(map),
                                     "export" + quotedBetweenSpaces(map) + quotedBetweenSpaces(out)}) {
    const Ended ended = runProgram(command);
    EXPECT_EQ(ended.exit_code, 0) << command << '\n' << ended.err;
    EXPECT_NE(ended.err.find(warning), std::string::npos) << command << '\n' << ended.err;
  }
  const Ended check = runProgram("check" + quotedBetweenSpaces(map));
  EXPECT_EQ(check.exit_code, 0) << check.out;
  EXPECT_NE(check.out.find("warning: " + warning), std::string::npos) << check.out;
}

TEST(Placement, PrefersTheNextFreeHomeOfAMap) {
  const fs::path map = roomWithHomes("two.map", {"100 100 90", "2000 1500 0"});
  const Ended check = runProgram("check" + quotedBetweenSpaces(map));
  EXPECT_EQ(check.exit_code, 0) << check.out;
  EXPECT_NE(check.out.find("at (2.000, 1.500) m, heading 0.0°, start 2 of 2 of the map two.map"), std::string::npos)
      << check.out;
  const Ended noisy = runProgram("run --noise on --time 1 --controller wander" + quotedBetweenSpaces(map));
  EXPECT_EQ(noisy.exit_code, 0) << noisy.err;
  EXPECT_EQ(countOf("stands at (2, 1.5) m, the next free start: ", noisy.err), 1u) << noisy.err;
}

TEST(BenchGold, RefusesAWorldWithoutGold) {
  EXPECT_NE(refusalOf("bench gold maps/office.map --runs 1").find("maps/office.map: has no gold"), std::string::npos);
}

TEST(Export, KeepsAMapsUnknownCellsOriginAndResolution) {
  const fs::path folder = emptyFolder();
  ASSERT_EQ(runProgram("export maps/lab.yaml" + quotedBetweenSpaces(folder / "lab.gridmap.gz") +
                       quotedBetweenSpaces(folder / "lab.YAML"))
                .exit_code,
            0);
  ASSERT_EQ(
      runProgram("export" + quotedBetweenSpaces(folder / "lab.gridmap.gz") + quotedBetweenSpaces(folder / "again.yaml"))
          .exit_code,
      0);
  EXPECT_EQ(textOf(folder / "lab.png"), textOf(folder / "again.png"));
  const std::string yaml = textOf(folder / "lab.YAML");
  EXPECT_NE(yaml.find("resolution: 0.05\n"), std::string::npos) << yaml;
  EXPECT_NE(yaml.find("origin: [-0.5, -0.5, 0]\n"), std::string::npos) << yaml;
}

TEST(Export, AcceptsExtensionsInUpperCase) {
  const fs::path folder = emptyFolder();
  EXPECT_EQ(runProgram("export worlds/small_maze.xml" + quotedBetweenSpaces(folder / "X.SVG") +
                       quotedBetweenSpaces(folder / "X.GridMap"))
                .exit_code,
            0);
  EXPECT_TRUE(fs::exists(folder / "X.SVG"));
  EXPECT_TRUE(fs::exists(folder / "X.GridMap"));
}

TEST(Help, NamesRangesAndUnitsInWords) {
  for (const std::string command : {"run", "serve", "bench gold", "geometry", "export"}) {
    const std::string help = runProgram(command + " --help").out;
    EXPECT_EQ(help.find("INT:INT"), std::string::npos) << command;
  }
  const std::string help = runProgram("run --help").out;
  EXPECT_NE(help.find("--time SECONDS"), std::string::npos) << help;
  EXPECT_NE(help.find("(0.001 to 1,000,000,000; default 1800)"), std::string::npos) << help;
  EXPECT_NE(help.find("--step SECONDS"), std::string::npos) << help;
  EXPECT_NE(help.find("(0.001 to 1; default 0.1)"), std::string::npos) << help;
}

}  // namespace
}  // namespace robosim
