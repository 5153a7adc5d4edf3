#include "robots/world_source.h"

#include <gtest/gtest.h>

namespace robosim {
namespace {

TEST(WorldSource, OfATextHasTheFilesThatItsFileWouldHave) {
  const std::string file = ROBOSIM_SOURCE_DIR "/worlds/lab_map.xml";
  const WorldSource of_file = readWorldSource(file);
  const WorldSource of_text = worldSourceOf(of_file.text, ROBOSIM_SOURCE_DIR "/worlds/not_written.xml");
  EXPECT_EQ(of_text.files, of_file.files);
  EXPECT_FALSE(of_text.files.empty());
  EXPECT_EQ(versionOf(of_text), versionOf(of_file));
}

TEST(WorldSource, OfATextReportsMissingMapsByFileAndLine) {
  try {
    worldSourceOf(
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
