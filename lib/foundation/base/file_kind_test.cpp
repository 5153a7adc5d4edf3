#include "base/file_kind.h"

#include <fstream>

#include <gtest/gtest.h>

#include "base/error_list.h"
#include "base/testing/test_folder.h"

namespace robosim {
namespace {

TEST(FileKind, IsRecognisedByTheFirstBytes) {
  EXPECT_EQ(kindOfBytes("<?xml version='1.0'?>\n<!-- a -->\n<world unit_m='1'>"), FileKind::world);
  EXPECT_EQ(kindOfBytes("\xef\xbb\xbf <world>"), FileKind::world);
  EXPECT_EQ(kindOfBytes("<robot name='a'>"), FileKind::robot_type);
  EXPECT_EQ(kindOfBytes("<RobotInfo>"), FileKind::robot_list);
  EXPECT_EQ(kindOfBytes("<sdf version='1.6'>"), FileKind::other_xml);
  EXPECT_EQ(kindOfBytes("\x89PNG\r\n"), FileKind::picture);
  EXPECT_EQ(kindOfBytes("P5\n# a\n4 4"), FileKind::picture);
  EXPECT_EQ(kindOfBytes("2D-Map\n"), FileKind::activmedia);
  EXPECT_EQ(kindOfBytes("# a map\nimage: a.png\n"), FileKind::ros_yaml);
  EXPECT_EQ(kindOfBytes("\x93"
                        "COccupancyGridMap2D\x06"),
            FileKind::gridmap);
  EXPECT_EQ(kindOfBytes("\x9f"
                        "mrpt::maps::COccupancyGridMap2D\x06"),
            FileKind::gridmap);
  EXPECT_EQ(kindOfBytes("\x8d"
                        "CSensoryFrame\x02"),
            FileKind::rawlog);
  EXPECT_EQ(kindOfBytes("\x0d"
                        "CSensoryFrame\x02"),
            FileKind::rawlog)
      << "of an old MRPT";
}

TEST(FileKind, IsRecognisedForFilesOfOtherPrograms) {
  EXPECT_EQ(kindOfBytes("# Octomap OcTree binary file\n"), FileKind::octomap);
  EXPECT_EQ(kindOfBytes("# Octomap OcTree file\n"), FileKind::octomap);
  EXPECT_EQ(kindOfBytes("BM:"), FileKind::bmp);
  EXPECT_EQ(kindOfBytes("\xff\xd8\xff\xe0"), FileKind::jpeg);
  EXPECT_EQ(kindOfBytes("# a world\n\ndefine wall model ( size [1 1 1] )\n"), FileKind::stage_world);
  EXPECT_EQ(kindOfBytes("include \"pioneer.inc\"\n"), FileKind::stage_world);
  EXPECT_EQ(kindOfBytes("resolution 0.02\nwindow ( )\n"), FileKind::stage_world);
  EXPECT_EQ(kindOfBytes("window\n(\n size [1 1]\n)\n"), FileKind::stage_world);
  EXPECT_EQ(kindOfBytes("resolution: 0.05\nimage: a.png\n"), FileKind::ros_yaml);
  EXPECT_EQ(kindOfBytes("name of a thing\n"), FileKind::unknown);
  EXPECT_EQ(kindOfBytes("# CARMEN log\nFLASER 1 1.0\n"), FileKind::carmen_log);
  EXPECT_EQ(kindOfBytes("ODOM 0 0 0 0 0 0 1.0 host 1.0\n"), FileKind::carmen_log);
  EXPECT_EQ(kindOfBytes("SQLite format 3"), FileKind::sqlite);
  EXPECT_EQ(kindOfBytes("\x8a"
                        "CSimpleMap\x01"),
            FileKind::simple_map);
  EXPECT_EQ(kindOfBytes(std::string("\x16\0\0\0CSensFrameProbSequence\0\0\0\0", 30)), FileKind::simple_map)
      << "before 2008";
}

TEST(FileKind, IsUnknownForAnythingElse) {
  for (const char* text : {"", "hello", " \n", "define", "B"}) EXPECT_EQ(kindOfBytes(text), FileKind::unknown) << text;
  EXPECT_EQ(kindOfFile("/none/such"), FileKind::unknown);
  EXPECT_EQ(kindOfFile("/dev/stdin"), FileKind::unknown);
}

class FileKindOfFile : public TestFolder {};

TEST_F(FileKindOfFile, IsNamedInTheRefusalWithWhatToDo) {
  const auto file = in("a.xml");
  std::ofstream(file, std::ios::binary) << "\x8d"
                                           "CSensoryFrame\x02";
  EXPECT_NO_THROW(requireKind(file, kRecordingKinds));
  try {
    requireKind(file, kWorldKinds);
    ADD_FAILURE() << "was accepted";
  } catch (const ConfigError& error) {
    EXPECT_EQ(error.what(), file.string() + ": is a rawlog, a recording: robosim replay, view, export and fit take it");
  }
  std::ofstream(file) << "<sdf/>";
  EXPECT_NO_THROW(requireKind(file, kWorldKinds)) << "the reader names the line of what is wrong with it";
}

}  // namespace
}  // namespace robosim
