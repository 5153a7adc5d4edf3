#include "robots/robot_colors.h"

#include <gtest/gtest.h>

#include "world/world_file.h"

namespace robosim {
namespace {

using Rgb = std::array<float, 3>;

const std::vector<std::filesystem::path> kFolders{ROBOSIM_SOURCE_DIR "/worlds/robots"};

/// Colours of robots of these types and <color> elements, 2 m apart.
std::vector<Rgb> colorsOf(const std::vector<std::pair<std::string, std::string>>& robots) {
  std::string text = "<world><surface><size><xmin>-50</xmin><xmax>50</xmax><ymin>-50</ymin><ymax>50</ymax></size>";
  for (std::size_t i = 0; i < robots.size(); ++i) {
    text += "<object><shape><robot><model>" + robots[i].first + "</model><name>R" + std::to_string(i) + "</name><x>" +
            std::to_string(2 * i) + "</x><y>0</y>" + robots[i].second + "</robot></shape></object>";
  }
  ErrorList errors;
  const World world = parseWorld(text + "</surface></world>", "w.xml", errors);
  const Fleet fleet = buildFleet(world, "w.xml", robotTypesIn(kFolders), {}, errors);
  errors.throwIfAny();
  ErrorList more;
  const Fleet again = buildFleet(world, "w.xml", fleet, more);
  std::vector<Rgb> colors;
  for (std::size_t i = 0; i < fleet.robots.size(); ++i) {
    colors.push_back(fleet.robots[i].color);
    EXPECT_EQ(again.robots[i].color, colors.back()) << "however the fleet is made";
  }
  return colors;
}

TEST(RobotColors, AreThoseOfTheWorldFile) {
  const Rgb green{0, 1, 0};
  EXPECT_EQ(colorsOf({{"pioneer3dx", "<color>0 1 0</color>"}, {"scout", "<color>0 1 0</color>"}}),
            (std::vector{green, green}))
      << "a team";
}

TEST(RobotColors, TellRobotsOfOneTypeApart) {
  const auto colors = colorsOf({{"pioneer3dx", ""}, {"pioneer3dx", ""}, {"scout", ""}});
  EXPECT_EQ(colors[0], paletteColor(0));
  EXPECT_EQ(colors[1], paletteColor(1));
  EXPECT_EQ(colors[2], colorsOf({{"scout", ""}})[0]) << "the only one of its type";
  EXPECT_EQ(colorsOf({{"pioneer3dx", "<color>0 1 0</color>"}, {"pioneer3dx", ""}})[1],
            colorsOf({{"pioneer3dx", ""}})[0]);
}

TEST(RobotColors, HaveAPaletteOfDistinctColours) {
  for (std::size_t i = 0; i < 40; ++i) {
    for (std::size_t k = 0; k < i; ++k) EXPECT_NE(paletteColor(i), paletteColor(k)) << i << ", " << k;
  }
}

}  // namespace
}  // namespace robosim
