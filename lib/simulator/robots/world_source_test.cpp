#include "robots/world_source.h"

#include <cmath>
#include <fstream>

#include <gtest/gtest.h>

#include "base/testing/test_folder.h"
#include "world/map_reader.h"

namespace robosim {
namespace {

/// Reads files of maps, for which this test has no formats.
class WorldSourceWithMaps : public testing::Test {
 protected:
  void SetUp() override {
    setMapReaders({.read = [](const std::string& name, const FileProvider& files, const MapReading&) {
      files.read(name);
      return FloorPlan();
    }});
  }
  void TearDown() override { setMapReaders({}); }
};

TEST_F(WorldSourceWithMaps, OfATextHasTheFilesThatItsFileWouldHave) {
  const std::string file = ROBOSIM_SOURCE_DIR "/worlds/lab_map.xml";
  const WorldSource of_file = readWorldSource(file);
  const WorldSource of_text = completeWorldSource(of_file.text, ROBOSIM_SOURCE_DIR "/worlds/not_written.xml");
  EXPECT_EQ(of_text.files, of_file.files);
  EXPECT_FALSE(of_text.files.empty());
  EXPECT_EQ(versionOf(of_text), versionOf(of_file));
}

TEST_F(WorldSourceWithMaps, OfATextReportsMissingMapsByFileAndLine) {
  try {
    completeWorldSource(
        "<world><surface><size><xmin>0</xmin><xmax>1</xmax><ymin>0</ymin><ymax>1</ymax></size>\n"
        "<map file='none.gridmap'/></surface></world>",
        "folder/w.xml");
    FAIL();
  } catch (const ConfigError& error) {
    EXPECT_EQ(std::string(error.what()).rfind("folder/w.xml:2: ", 0), 0u) << error.what();
  }
}

class WorldSourceOfStage : public TestFolder {};

TEST_F(WorldSourceOfStage, MovesRobotsWhoseDiscsOverlap) {
  // The discs of boxes of 0.4 m have a radius of 0.283 m. The third robot stands clear.
  std::ofstream(in("w.world")) << "define bot position ( size [0.4 0.4 0.3] )\nbot ( name \"a\" pose [0 0 0 0] )\n"
                                  "bot ( name \"b\" pose [0.5 0 0 90] )\nbot ( name \"c\" pose [3 0 0 0] )\n";
  StageNotes notes;
  const WorldSource source = readWorldSource(in("w.world"), &notes);
  const LoadedWorld loaded = loadWorld(source, {});
  ASSERT_EQ(loaded.fleet.robots.size(), 3u);
  EXPECT_EQ(loaded.fleet.robots[0].world_from_start, mrpt::math::TPose2D(0, 0, 0));
  EXPECT_EQ(loaded.fleet.robots[2].world_from_start, mrpt::math::TPose2D(3, 0, 0));
  const auto& moved = loaded.fleet.robots[1].world_from_start;
  EXPECT_GT(std::hypot(moved.x, moved.y), 2 * 0.2828);
  EXPECT_NEAR(moved.phi, M_PI / 2, 1e-12);
  ASSERT_EQ(notes.lines.size(), 1u);
  EXPECT_NE(notes.lines[0].find("w.world: robot 'b' is moved from (0.500, 0.000) m to "), std::string::npos)
      << notes.lines[0];
}

}  // namespace
}  // namespace robosim
