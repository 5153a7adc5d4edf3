// Texts from files and command lines as printed by the program: no control characters, no forged lines, no lines of
// megabytes.
#include <algorithm>
#include <fstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/utf8.h"
#include "tests/scenarios/program.h"

namespace robosim {
namespace {

/// A line that a text attempts to add to the output.
const std::string kForged = "FORGED: the run was fine";

/// Checks that the output is well-formed UTF-8 without control characters other than line feeds, without lines that
/// begin with the forged text, and without lines of more than some thousand bytes.
void expectPrintable(const Ended& ended) {
  for (const std::string& text : {ended.out, ended.err}) {
    EXPECT_TRUE(isUtf8(text));
    EXPECT_TRUE(std::none_of(text.begin(), text.end(), [](char c) {
      return (static_cast<unsigned char>(c) < 0x20 && c != '\n') || c == 0x7f;
    })) << text;
    for (const char* c1 : {"\u0080", "\u009b", "\u009f", "\u202e", "\u2028"}) {
      EXPECT_EQ(text.find(c1), std::string::npos) << text;
    }
    EXPECT_EQ(("\n" + text).find("\n" + kForged), std::string::npos) << text;
    for (std::size_t begin = 0; begin < text.size();) {
      const std::size_t end = std::min(text.find('\n', begin), text.size());
      EXPECT_LT(end - begin, 5000u);
      begin = end + 1;
    }
  }
}

/// A world of one robot with this name, in XML escapes.
std::string worldWithRobot(const std::string& name) {
  return "<world><surface><size><xmin>-5</xmin><xmax>5</xmax><ymin>-5</ymin><ymax>5</ymax></size><object><shape><robot>"
         "<model>pioneer3dx</model><name>" +
         name +
         "</name><x>0</x><y>0</y><direction>0</direction><controller>wander</controller></robot></shape></object>"
         "</surface></world>";
}

std::filesystem::path written(const std::string& name, const std::string& text) {
  const auto file = emptyFolder() / name;
  std::ofstream(file, std::ios::binary) << text;
  return file;
}

TEST(PrintedText, EscapesControlCharactersInRobotNames) {
  const auto world = written("world.xml", worldWithRobot("a&#x9b;2J&#10;" + kForged + "&#x202e;"));
  const Ended check = runProgram("check " + quoted(world));
  EXPECT_EQ(check.exit_code, 0) << check.err;
  EXPECT_NE(check.out.find("a\\x9b2J\\x0aFORGED"), std::string::npos) << check.out;
  expectPrintable(check);
  expectPrintable(runProgram("run " + quoted(world) + " --time 1"));

  const Ended as_json = runProgram("check --json " + quoted(world));
  expectPrintable(as_json);
  EXPECT_EQ(nlohmann::json::parse(as_json.out)["robots"][0], "a\u009b2J\n" + kForged + "\u202e") << "the same name";
}

TEST(PrintedText, EscapesControlCharactersInWorldFileErrors) {
  const std::string bad = "&#x9b;2J&#10;" + kForged;
  const auto world = written(
      "world.xml", "<world unit_m='" + bad + "'><surface type='" + bad + "'><size><xmin>" + bad +
                       "</xmin><xmax>5</xmax><ymin>-5</ymin><ymax>5</ymax></size>\n<map file='" + bad +
                       "'/>\n<object><shape><robot><model>" + bad + "</model><name>" + bad +
                       "</name><x>0</x><y>0</y><direction>0</direction></robot></shape></object></surface></world>");
  for (const std::string command : {"check ", "run "}) {
    const Ended ended = runProgram(command + quoted(world));
    EXPECT_EQ(ended.exit_code, 1);
    expectPrintable(ended);
  }
}

TEST(PrintedText, EscapesControlCharactersInMapErrors) {
  const std::string attack =
      "\x1b[2J\x9b"
      "2J\xff\u202e\r";
  const std::string maps[][2] = {{"a.map", "2D-Map\nLINES\n1 2 " + attack + " 4\n"},
                                 {"b.map", "2D-Map\nCairn: RobotHome " + attack + " 2 3 \"\" ICON \"x\"\n"},
                                 {"c.yaml", "image: \"\\e[2J\\n" + kForged +
                                                "\"\nresolution: 0.05\norigin: [0, 0, 0]\nnegate: 0\n"
                                                "occupied_thresh: 0.65\nfree_thresh: 0.196\n"},
                                 {"d.yaml", "image: a.png\nresolution: \"\\x9b2J\\n" + kForged +
                                                "\"\norigin: [0, 0, 0]\nnegate: 0\n"
                                                "occupied_thresh: 0.65\nfree_thresh: 0.196\nmode: \"\\e[2J\"\n"}};
  for (const auto& [name, text] : maps) {
    const Ended check = runProgram("check " + quoted(written(name, text)));
    EXPECT_EQ(check.exit_code, 1) << name << check.out;
    expectPrintable(check);
  }
}

TEST(PrintedText, EscapesControlCharactersInFileNamesAndArguments) {
  const auto folder = emptyFolder();
  const auto world = folder / ("w\x1b[2J\n" + kForged + ".xml");
  std::ofstream(world) << worldWithRobot("R");
  for (const std::string command : {"check ", "check --json ", "run --time 1 "}) {
    const Ended ended = runProgram(command + quoted(world));
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    expectPrintable(ended);
  }
  const auto missing = folder / ("missing\x1b[2J\n" + kForged);
  for (const std::string command : {"run ", "check ", "replay ", "view --offscreen a.png ", "control load "}) {
    const Ended ended = runProgram(command + quoted(missing));
    EXPECT_NE(ended.exit_code, 0);
    expectPrintable(ended);
  }
  expectPrintable(runProgram("'fly\x1b[2J'"));
  expectPrintable(runProgram("run worlds/small_maze.xml '--fly\x1b[2J'"));
}

TEST(PrintedText, AbbreviatesHugeValues) {
  const std::string megabytes(8'000'000, 'x');
  const auto world = written("world.xml", "<world><surface type='smooth'><size><xmin>" + megabytes +
                                              "</xmin><xmax>5</xmax><ymin>-5</ymin><ymax>5</ymax></size></surface>\n<" +
                                              std::string(100'000, 'y') + "/><a b='" + megabytes + "'/></world>");
  const Ended check = runProgram("check " + quoted(world));
  EXPECT_EQ(check.exit_code, 1);
  EXPECT_NE(check.out.find("is not a number"), std::string::npos) << "what is wrong is behind the value";
  expectPrintable(check);
  expectPrintable(runProgram(
      "check " + quoted(written("a.map", "2D-Map\nCairn: RobotHome " + megabytes + " 2 3 \"\" ICON \"x\"\n"))));
}

}  // namespace
}  // namespace robosim
