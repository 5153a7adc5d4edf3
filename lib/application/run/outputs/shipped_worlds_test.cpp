// The worlds and robot types in worlds/, and the examples in their documentation. In this module because some have
// maps.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "base/xml_parser.h"
#include "robots/fleet.h"
#include "run/outputs/standard_parts.h"
#include "world/world_file.h"

namespace robosim {
namespace {

using Lines = std::vector<std::string>;

const std::filesystem::path kWorlds = ROBOSIM_SOURCE_DIR "/worlds";

class Worlds : public testing::Test {
 protected:
  void SetUp() override { useStandardParts(); }
};

TEST_F(Worlds, ShippedWorldsLoadAndRoundTrip) {
  int worlds = 0;
  for (const auto& entry : std::filesystem::directory_iterator(kWorlds)) {
    if (entry.path().extension() != ".xml") continue;
    SCOPED_TRACE(entry.path());
    ++worlds;
    const LoadedWorld loaded = loadWorld(entry.path(), nullptr);
    EXPECT_FALSE(loaded.fleet.robots.empty());
    ErrorList errors;
    EXPECT_EQ(parseWorld(toXml(loaded.world), entry.path().string(), filesOnDisk(entry.path()), errors), loaded.world);
    EXPECT_EQ(errors.errors(), Lines{});
  }
  EXPECT_GE(worlds, 4);
}

TEST_F(Worlds, World2005LoadsUnchanged) {
  const LoadedWorld loaded = loadWorld(ROBOSIM_SOURCE_DIR "/tests/data/legacy_world.xml", nullptr);
  ASSERT_EQ(loaded.fleet.robots.size(), 1u);
  const RobotInfo& finder = loaded.fleet.robots[0].info;
  EXPECT_EQ(finder.name, "Finder1");
  Lines labels;
  for (const auto& sensor : *finder.sensors) labels.push_back(sensor.label);
  EXPECT_EQ(labels, (Lines{"heat", "sonar", "laser", "odometry"}));
  EXPECT_EQ(finder.sensors->at(1).beams.size(), 16u);
  EXPECT_EQ(finder.sensors->at(1).no_echo_m, 16);
  EXPECT_EQ(finder.sensors->at(2).no_echo_m, 21);
}

TEST_F(Worlds, ExamplesInTheirDocumentationLoad) {
  std::string doc;
  for (const char* page : {"world_file", "robot_type", "sensors"}) {
    std::ifstream in(std::string(ROBOSIM_SOURCE_DIR "/doc/") + page + ".md");
    doc.append(std::istreambuf_iterator<char>(in), {});
  }
  const std::string fence = "```xml\n";
  ErrorList errors;
  int examples = 0;
  const auto text = [](const XmlElement& e) { return toXml(e).substr(toXml(e).find("<" + e.name)); };
  for (auto begin = doc.find(fence); begin != std::string::npos; begin = doc.find(fence, begin)) {
    begin += fence.size();
    const XmlElement example = parseXml(doc.substr(begin, doc.find("```", begin) - begin), "doc");
    ++examples;
    if (example.name == "world") {
      EXPECT_EQ(buildFleet(parseWorld(toXml(example), "w.xml", errors), "w.xml", robotTypesIn({kWorlds / "robots"}),
                           nullptr, errors)
                    .robots.size(),
                1u);
    } else if (example.name == "robot") {
      EXPECT_EQ(modelOf(example, "tortoise.xml", {}, errors).sensors.size(), 2u);
    } else if (example.name == "sensors") {
      XmlElement type = readXmlFile(kWorlds / "robots" / "pioneer3dx.xml");
      std::find_if(type.children.begin(), type.children.end(), [](const auto& e) {
        return e.name == "sensors";
      })->children = example.children;
      EXPECT_EQ(modelOf(type, "pioneer3dx.xml", {}, errors).sensors.size(), 2u);
    } else if (example.name == "map") {
      const auto beside = kWorlds / "some.xml";
      const std::string world = "<world><surface>" + text(example) + "</surface></world>";
      EXPECT_EQ(parseWorld(world, beside.string(), filesOnDisk(beside), errors).maps.size(), 1u);
    } else if (example.name == "scatter") {
      const World world = parseWorld(
          "<world><surface><size xmin='-9' xmax='9' ymin='-9' ymax='9'/>" + text(example) + "</surface></world>",
          "w.xml", errors);
      EXPECT_EQ(world.scatters.at(0).count, 20);
    } else if (example.name == "object") {
      const World world = parseWorld(
          "<world><surface><size xmin='-9' xmax='9' ymin='-9' ymax='9'/>" + text(example) + "</surface></world>",
          "w.xml", errors);
      EXPECT_TRUE(world.objects.at(0).body.isFloor());
    } else if (example.name == "georeference") {
      const World world = parseWorld(
          "<world><surface><size xmin='-9' xmax='9' ymin='-9' ymax='9'/></surface>" + text(example) + "</world>",
          "w.xml", errors);
      EXPECT_EQ(world.georeference.value().origin.altitude_m, 519);
    } else if (example.name == "communication") {
      const World world = parseWorld(
          "<world><surface><size xmin='-9' xmax='9' ymin='-9' ymax='9'/></surface>" + text(example) + "</world>",
          "w.xml", errors);
      EXPECT_EQ(world.communication.wall_range_m, 4);
      EXPECT_EQ(world.communication.rate_hz, 10);
    }
  }
  EXPECT_EQ(errors.errors(), Lines{});
  EXPECT_EQ(examples, 10);
}

TEST_F(Worlds, ShippedRobotTypesLoad) {
  int types = 0;
  for (const auto& entry : std::filesystem::directory_iterator(kWorlds / "robots")) {
    ErrorList errors;
    const RobotModel model = readRobotModel(entry.path(), errors);
    EXPECT_EQ(errors.errors(), Lines{});
    EXPECT_FALSE(model.help.empty()) << entry.path();
    ++types;
  }
  EXPECT_GE(types, 2);
}

}  // namespace
}  // namespace robosim
