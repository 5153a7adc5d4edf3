#include "rendering/svg_plan.h"

#include <numbers>

#include <gtest/gtest.h>

#include "base/xml_parser.h"

namespace robosim {
namespace {

World smallWorld() {
  World world;
  world.name = "a <small> & simple world";
  world.bounds = {0, 10, 0, 5};
  Body body;
  body.shape = Cube{4, 0.5};
  body.world_from_body = {3, 3.5, std::numbers::pi / 6};
  body.color = {0, 0, 1};
  body.height_m = 1;
  world.objects.push_back({.name = "wall", .body = body, .stationary = true, .line = {}});
  body.shape = Cylinder{0.3};
  body.world_from_body = {8.5, 3.5, 0};
  body.heat_celsius = 20;
  world.objects.push_back({.name = "gold", .body = body, .stationary = true, .line = {}});
  return world;
}

Fleet oneRobot() {
  FleetRobot robot;
  robot.info.name = "Ann";
  robot.info.model = "scout";
  robot.info.radius_m = 0.2;
  robot.world_from_start = {1, 2, std::numbers::pi / 2};
  robot.body.shape = Cylinder{0.2};
  robot.body.world_from_body = robot.world_from_start;
  return {{robot}};
}

std::string attribute(const XmlElement& element, const std::string& name) {
  for (const auto& [key, value] : element.attributes) {
    if (key == name) return value;
  }
  return "";
}

/// All elements with a tag, at any depth.
void find(const XmlElement& in, const std::string& tag, std::vector<XmlElement>& found) {
  if (in.name == tag) found.push_back(in);
  for (const auto& child : in.children) find(child, tag, found);
}
std::vector<XmlElement> all(const XmlElement& svg, const std::string& tag) {
  std::vector<XmlElement> found;
  find(svg, tag, found);
  return found;
}

bool hasText(const XmlElement& svg, const std::string& text) {
  const auto texts = all(svg, "text");
  return std::any_of(texts.begin(), texts.end(), [&](const XmlElement& element) { return element.text == text; });
}

TEST(SvgPlan, IsADocumentInMetresWithYUpwards) {
  const XmlElement svg = parseXml(toSvg(smallWorld(), oneRobot()), "plan.svg");
  EXPECT_EQ(svg.name, "svg");
  EXPECT_EQ(attribute(svg, "xmlns"), "http://www.w3.org/2000/svg");
  EXPECT_EQ(svg.children[0].text, "a <small> & simple world");
  const auto circles = all(svg, "circle");  // the gold's glow, the gold, the robot
  ASSERT_EQ(circles.size(), 3u);
  EXPECT_EQ(attribute(circles[1], "cx"), "8.5");
  EXPECT_EQ(attribute(circles[1], "cy"), "-3.5");
  EXPECT_EQ(attribute(circles[1], "r"), "0.3");
  EXPECT_EQ(attribute(circles[1], "fill"), "#0000ff");
  EXPECT_EQ(attribute(all(svg, "rect").back(), "transform"), "translate(3 -3.5) rotate(-30)");
  EXPECT_EQ(attribute(all(svg, "rect").back(), "width"), "4");
  EXPECT_TRUE(hasText(svg, "gold"));
  EXPECT_FALSE(hasText(svg, "wall")) << "only hot objects are named";
  EXPECT_TRUE(hasText(svg, "Ann"));
  EXPECT_TRUE(hasText(svg, "1 m"));
}

TEST(SvgPlan, DrawsTheCellsOfAMapAsOnePath) {
  World world = smallWorld();
  WorldMap map;
  map.file = "lab.yaml";
  map.color = {1, 0, 0};
  map.world_from_map = {1, 1, 0};
  map.plan.map_from_grid = {2, 0.5, std::numbers::pi / 2};
  map.plan.columns = map.plan.rows = 9;
  map.plan.cell_m = 0.05;
  map.plan.occupied = {{0, 0, 3, 1}, {5, 2, 1, 4}};
  map.plan.boxes = {{{0, 0, 0}, 2, 0.002}};
  world.maps = {map};
  const XmlElement svg = parseXml(toSvg(world, {}), "plan.svg");
  const auto paths = all(svg, "path");
  const auto cells = std::find_if(paths.begin(), paths.end(), [](const XmlElement& path) {
    return attribute(path, "d") == "M0 0h3v1h-3zM5 2h1v4h-1z";
  });
  ASSERT_NE(cells, paths.end());
  EXPECT_EQ(attribute(*cells, "transform"), "translate(3 -1.5) rotate(-90) scale(0.05 -0.05)");
}

TEST(SvgPlan, WritesTheNameOfARobotAboveIt) {
  World world;
  world.bounds = {0, 10, 0, 5};
  const XmlElement svg = parseXml(toSvg(world, oneRobot()), "plan.svg");
  int names = 0;
  for (const auto& text : all(svg, "text")) {
    if (text.text != "Ann") continue;
    ++names;
    EXPECT_EQ(std::stod(attribute(text, "x")), 1);
    EXPECT_LT(std::stod(attribute(text, "y")), -2.2) << "y is downwards; the robot's rim is at 2.2 m";
  }
  EXPECT_EQ(names, 1);
}

TEST(SvgPlan, IsWellFormedForAnyNames) {
  World world = smallWorld();
  world.name = "caf\xe9";
  world.objects[1].name = "\x01<b>\"'&amp;\n";
  const XmlElement svg = parseXml(toSvg(world, oneRobot()), "plan.svg");
  EXPECT_EQ(svg.children[0].text, "caf?");
  EXPECT_TRUE(hasText(svg, "?<b>\"'&amp;?"));
}

TEST(SvgPlan, OfAnEmptyWorldShowsTheFloor) {
  World world;
  world.bounds = {0, 1, 0, 1};
  EXPECT_EQ(parseXml(toSvg(world, {}), "plan.svg").name, "svg");
}

}  // namespace
}  // namespace robosim
