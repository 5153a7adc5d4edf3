#include "robots/world_source.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace robosim
