#include "aria/robot_list.h"

#include <fstream>

#include <gtest/gtest.h>

#include "base/temporary_directory.h"

namespace robosim {
namespace {

using Lines = std::vector<std::string>;

/// What is said against a list of this text, without the file's name.
Lines faults(const std::string& text) {
  const TemporaryDirectory folder;
  const auto file = folder / "robots.xml";
  std::ofstream(file) << text;
  ErrorList errors;
  readRobotList(file, errors);
  Lines lines;
  for (const auto& error : errors.errors()) lines.push_back(error.substr(file.string().size()));
  return lines;
}

std::string robot(const std::string& name, const std::string& port, const std::string& primary) {
  return "<robot><hostname>h</hostname><port>" + port + "</port><name>" + name + "</name><primary>" + primary +
         "</primary></robot>\n";
}

TEST(RobotList, ReadsAListOf2005) {
  ErrorList errors;
  const auto list = readRobotList(ROBOSIM_SOURCE_DIR "/tests/data/legacy_robots.xml", errors);
  EXPECT_EQ(errors.errors(), Lines{});
  EXPECT_EQ(list,
            (std::vector<RobotAddress>{{"Finder1", "127.0.0.1", 9001, true}, {"Finder2", "127.0.0.1", 9002, false}}));
}

TEST(RobotList, RequiresExactlyOnePrimaryRobot) {
  EXPECT_EQ(faults("<RobotInfo>\n" + robot("A", "1", "1") + robot("B", "2", "1") + "</RobotInfo>"),
            Lines{":3: <primary>1</primary>: 'A' is primary already; write 0 for all robots but one"});
  const Lines none{":1: <RobotInfo>: no robot is primary; write <primary>1</primary> for the one to be driven first"};
  EXPECT_EQ(faults("<RobotInfo>\n" + robot("A", "1", "0") + "</RobotInfo>"), none);
  EXPECT_EQ(faults("<RobotInfo/>"), none);
}

TEST(RobotList, ReportsAllErrorsAtOnce) {
  EXPECT_EQ(faults("<RobotInfo>\n" + robot("A", "1", "1") + robot("A", "0", "0") + robot("C", "1.5", "no") +
                   "<robot><color/></robot>\n</RobotInfo>"),
            (Lines{":3: <port>0</port>: must lie in [1, 65535]; write a number there",
                   ":3: <name>A</name>: is in the list already; keep one of the two",
                   ":4: <port>1.5</port>: must be a whole number",
                   ":4: <primary>no</primary>: is unknown; accepted are: 0, 1",
                   ":5: <robot>: <hostname> is missing; add it", ":5: <robot>: <port> is missing; add it",
                   ":5: <robot>: <name> is missing; add it", ":5: <robot>: <primary> is missing; write 1 or 0 there",
                   ":5: <color>: unknown tag in <robot>; accepted here are: hostname, name, port, primary"}));
  EXPECT_EQ(faults("<world/>"), Lines{":1: <world>: is not a robot list; the first element of one is <RobotInfo>"});
  EXPECT_EQ(faults("<RobotInfo>"), Lines{":1: an element is closed by another's tag, or not at all (was the file cut "
                                         "off?); fix the file here or just before"});
}

TEST(RobotList, RejectsAMissingFile) {
  ErrorList errors;
  EXPECT_TRUE(readRobotList("/nowhere/robots.xml", errors).empty());
  EXPECT_EQ(errors.errors(), Lines{"/nowhere/robots.xml: no such file; check the path"});
}

}  // namespace
}  // namespace robosim
