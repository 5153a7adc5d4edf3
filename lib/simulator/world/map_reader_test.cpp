#include "world/map_reader.h"

#include <gtest/gtest.h>

#include "base/error_list.h"

namespace robosim {
namespace {

TEST(MapReader, RefusesMapsUntilReadersAreSet) {
  const FileProvider files = makeProvider("maps/world.xml", {{"lab.pgm", "P1 1 1 0"}});
  try {
    readMap("lab.pgm", files, {});
    FAIL();
  } catch (const ConfigError& error) {
    EXPECT_STREQ(error.what(),
                 "maps/lab.pgm: this program cannot read maps; it must call useMapFormats() of the library "
                 "robosim::maps");
  }
  EXPECT_EQ(filesOfMap("lab.yaml"), std::vector<std::filesystem::path>{"lab.yaml"});
}

TEST(MapReader, CallsTheReadersThatAreSet) {
  setMapReaders({.read =
                     [](const std::string& name, const FileProvider&, const MapReading& reading) {
                       FloorPlan plan;
                       plan.cell_m = reading.pixel_m + static_cast<double>(name.size());
                       return plan;
                     },
                 .files =
                     [](const std::filesystem::path& map) {
                       return std::vector{map, map};
                     }});
  MapReading reading;
  reading.pixel_m = 0.5;
  EXPECT_EQ(readMap("a.pgm", makeProvider("w.xml", {}), reading).cell_m, 5.5);
  EXPECT_EQ(filesOfMap("a").size(), 2u);
  setMapReaders({});
}

}  // namespace
}  // namespace robosim
