// Error texts as printed by the program: each states the problem and its location.
#include <fstream>

#include <gtest/gtest.h>

#include "base/data_folders.h"
#include "tests/scenarios/benchmark.h"

namespace robosim {
namespace {

constexpr const char* kYaml =
    "\nresolution: 0.5\norigin: [0, 0, 0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n";

class ErrorTexts : public testing::Test {
 protected:
  std::filesystem::path written(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return folder_ / name;
  }
  /// Output of `robosim check` for a file.
  std::string check(const std::string& name, const std::string& text) const {
    const Ended ended = runProgram("check '" + written(name, text).string() + "'");
    EXPECT_EQ(ended.exit_code, 1) << ended.out;
    return ended.out;
  }
  void expectLine(const std::string& text, const std::string& line) const {
    EXPECT_NE(text.find(folder_.string() + "/" + line), std::string::npos) << text << "has no\n" << line;
  }

  const std::filesystem::path folder_ = emptyFolder();
};

TEST_F(ErrorTexts, NameOnlyLinesOfTheMapsFiles) {
  expectLine(check("a.yaml", std::string("negate: 0\nimage: none.png") + kYaml),
             "a.yaml:2: image: none.png: " + (folder_ / "none.png").string() + ": no such file; check the path");
  expectLine(check("b.gridmap", "x"), "b.gridmap: is not an MRPT grid map");
}

TEST_F(ErrorTexts, NameTheWorldsLineForImageErrors) {
  written("a.png", "no picture");
  expectLine(check("a.xml", "<world>\n<surface>\n<map file='a.png' resolution='1'/></surface></world>"),
             "a.xml:3: <map file=\"a.png\">: ");
  expectLine(check("b.xml", "<world>\n<surface>\n<map file='a.jpg'/></surface></world>"),
             "b.xml:3: <map file=\"a.jpg\">: a.jpg: is not a map by its name");
}

TEST_F(ErrorTexts, NameTheEncodingAndControlCharacters) {
  expectLine(check("utf16.xml", std::string("\xff\xfe<\0w\0/\0>\0", 10)),
             "utf16.xml:1: the file is in the encoding UTF-16; save it as UTF-8");
  expectLine(check("control.xml", "<world>\n\x01</world>"),
             "control.xml:2: the control character \\x01 is not allowed in XML; take it out");
}

TEST_F(ErrorTexts, StateTheMinimumOfNumbersNearZero) {
  expectLine(check("a.xml", "<world unit_m='1e-400'>\n<surface/></world>"),
             "a.xml:1: <world unit_m=\"1e-400\">: must lie in (0, 1000]");
}

TEST_F(ErrorTexts, NameTheFoldersSearchedForARobotType) {
  const auto world =
      written("a.xml", R"(<world><surface><size><xmin>-5</xmin><xmax>5</xmax><ymin>-5</ymin><ymax>5</ymax></size>
<object><shape><robot><model>tortoise</model><name>R</name><x>0</x><y>0</y><direction>0</direction></robot></shape></object>
</surface></world>)");
  const Ended ended = runCommand("ROBOSIM_PATH=/none '" ROBOSIM_PROGRAM "' check '" + world.string() + "'");
  EXPECT_EQ(ended.exit_code, 1);
  const std::string shipped = (shareFolder() / "worlds" / "robots").string();
  EXPECT_NE(ended.out.find("there is no robot type 'tortoise'; known are: amigo-sh, "), std::string::npos) << ended.out;
  EXPECT_NE(ended.out.find("robot types are the *.xml files in robots/ beside the world file, in /none/robots, which "
                           "does not exist (ROBOSIM_PATH) and in " +
                           shipped),
            std::string::npos)
      << ended.out;
}

TEST_F(ErrorTexts, NameAnOptionThatIsGivenByItsFormerName) {
  struct Renamed {
    std::string program, former, option;
  };
  for (const auto& [program, former, option] :
       {Renamed{"'" ROBOSIM_PROGRAM "' robot R", "--patience", "--reconnect-timeout"},
        Renamed{"'" ROBOSIM_PROGRAM "' control status", "--every", "--interval"},
        Renamed{"'" ROBOSIM_BENCH "' network", "--crowd", "--layout"},
        Renamed{"'" ROBOSIM_BENCH "' speed", "--at-least", "--min-time"}}) {
    const Ended by_option = runCommand(program + " " + option + " x");
    EXPECT_EQ(by_option.exit_code, 1) << option;
    EXPECT_NE(by_option.err.find(option), std::string::npos) << by_option.err;
    EXPECT_EQ(runCommand(program + " " + former + " x").err, by_option.err) << former;
    EXPECT_EQ(runCommand(program + " --help").out.find(former), std::string::npos) << former;
  }
}

TEST_F(ErrorTexts, AcceptTheFormerNameOfAFlag) {
  const std::string program = "'" ROBOSIM_PROGRAM "' robot R --environment 127.0.0.1:1 --connect-timeout 0 ";
  EXPECT_NE(runCommand(program + "--apart").err.find("no environment answers at 127.0.0.1:1"), std::string::npos);
  EXPECT_NE(runCommand(program + "--apart --remote-port :0").err.find("--separate-processes"), std::string::npos);
}

TEST_F(ErrorTexts, ListTheKnownSubcommands) {
  const Ended bench = runProgram("bench foo");
  EXPECT_EQ(bench.exit_code, 1);
  EXPECT_EQ(bench.err.substr(0, 82),
            "robosim: there is no subcommand 'foo' of robosim bench; known are: gold, metrics; ");
  const Ended benchmark = runBenchmark("foo");
  EXPECT_EQ(benchmark.exit_code, 1);
  EXPECT_EQ(benchmark.err.substr(0, 75), "robosim_bench: there is no subcommand 'foo' of robosim_bench; known are: sp");
  const Ended robosim = runProgram("foo");
  EXPECT_EQ(robosim.exit_code, 1);
  EXPECT_EQ(robosim.err.substr(0, 63), "robosim: there is no subcommand 'foo' of robosim; known are: ru");
}

}  // namespace
}  // namespace robosim
