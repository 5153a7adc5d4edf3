#include "sensors/laser_types.h"

#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

#include <gtest/gtest.h>

#include "base/angle_units.h"
#include "sensors/testing/single_robot_scene.h"

namespace robosim {
namespace {

/// The <laser> elements of the tables of a page, by the value of their attribute `noise`.
std::map<std::string, std::string> lasersOf(const std::string& page) {
  std::ostringstream text;
  text << std::ifstream(page).rdbuf();
  std::map<std::string, std::string> found;
  const std::string all = text.str(), begins = "| `<laser ", noise = "noise=\"";
  for (auto begin = all.find(begins); begin != std::string::npos; begin = all.find(begins, begin + 1)) {
    const auto first = all.find('<', begin);
    const std::string element = all.substr(first, all.find('`', first) - first);
    const auto name = element.find(noise) + noise.size();
    found[element.substr(name, element.find('"', name) - name)] = element;
  }
  return found;
}

TEST(LaserTypes, DocumentedScannersHaveTheGeometryOfTheirDataSheets) {
  auto documented = lasersOf(ROBOSIM_SOURCE_DIR "/doc/sensors.md");
  ASSERT_EQ(documented.size(), 3u);
  struct DataSheet {
    std::size_t beams;
    double step_deg, range_min_m, range_max_m;
  };
  const std::map<std::string, DataSheet> sheets{
      {"lms200", {181, 1, 0, 80}}, {"urg04lx", {682, 360.0 / 1024, 0.02, 5.6}}, {"utm30lx", {1081, 0.25, 0.1, 30}}};
  for (const auto& [name, sheet] : sheets) {
    ASSERT_NE(laserTypeNamed(name), nullptr);
    const auto laser = sensorFrom(documented[name]);
    const SensorInfo& info = laser->info();
    EXPECT_TRUE(laser->isNoisy()) << name;
    ASSERT_EQ(info.beams.size(), sheet.beams) << name;
    const double field_rad = info.beams.back().robot_from_beam.yaw - info.beams.front().robot_from_beam.yaw;
    EXPECT_NEAR(toDegrees(field_rad) / static_cast<double>(sheet.beams - 1), sheet.step_deg, 1e-4) << name;
    EXPECT_DOUBLE_EQ(info.range_min_m, sheet.range_min_m);
    EXPECT_DOUBLE_EQ(info.range_max_m, sheet.range_max_m);
  }
}

}  // namespace
}  // namespace robosim
