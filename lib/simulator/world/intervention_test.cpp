#include "world/intervention.h"

#include <gtest/gtest.h>

#include "base/error_list.h"
#include "world/world_file.h"

namespace robosim {
namespace {

std::vector<Change> oneOfEachKind() {
  WorldObject box;
  box.name = "a \"box\" & <more>";
  box.body = {Cube{0.1, 1.0 / 3}, {1, -2.5, 0.7}, 0.2, 0.4, {0.1f, 1, 0}, 30, 0.25};
  Communication radio;
  radio.range_m = 12.5;
  radio.wall_range_m = 0.1;
  radio.delay_s = 0.3;
  return {PlaceBody{"a", 1.0 / 3, -2},
          PlaceBody{"a", 1, 2, 0.1},
          AddObject{box},
          AddRobot{"r2", "pioneer3dx", {1.0 / 3, -2, 0.7}},
          AddRobot{"r2", "scout", {1, 2, -4}, "hold a=1 b=x", "r1", {{0.1f, 1, 0}}},
          AddRobot{"r2", "scout", {}, "gold_finder"},
          RemoveBody{"a"},
          ChangeObject{"a", 20, {{1, 0.5f, 0.1f}}, 1.25, 0.9},
          ChangeObject{.name = "a", .reflectivity = 0},
          ChangeObject{.name = "a", .properties = {0.0, 7.0}},
          ChangeObject{.name = "a", .properties = {1.0 / 3, {}}},
          ChangeActivity{"r1", Activity::found},
          ChangeRadio{radio},
          ChangeRadio{},
          EndRun{"goal", "red has scored"},
          OpenDoor{"door"},
          OpenDoor{"door", 1.0 / 3},
          EndRun{"over"}};
}

TEST(Intervention, HasATextThatReadsBackEqual) {
  for (const Change& change : oneOfEachKind()) {
    const std::string text = changeText(change);
    EXPECT_EQ(text.find('\n'), std::string::npos) << text;
    EXPECT_EQ(parseChange(text, "test"), change) << text;
    EXPECT_EQ(faultOf(change), "") << text;
  }
  EXPECT_EQ(changeText(oneOfEachKind()[1]), "<place name=\"a\" x=\"1\" y=\"2\" direction=\"0.1\"/>");
}

TEST(Intervention, IsReadFromAWorldFileInItsUnitAndWrittenBack) {
  const std::string text =
      "<world unit_m=\"0.01\"><surface><size><xmin>0</xmin><xmax>900</xmax><ymin>0</ymin><ymax>900</ymax></size>"
      "</surface>\n<at time=\"20\"><place name=\"gold\" x=\"150\" y=\"25\"/><remove name=\"wall\"/></at>\n"
      "<at time=\"5.5\"><change name=\"gold\" height=\"30\"/>"
      "<add><robot><model>scout</model><name>new</name><x>100</x><y>50</y></robot></add></at></world>";
  ErrorList errors;
  const World world = parseWorld(text, "a.xml", errors);
  EXPECT_EQ(errors.errors(), std::vector<std::string>{});
  const std::vector<TimedChange> expected{{5.5, ChangeObject{.name = "gold", .height_m = 0.3}, {}},
                                          {5.5, AddRobot{"new", "scout", {1, 0.5, 0}}, {}},
                                          {20, PlaceBody{"gold", 1.5, 0.25}, {}},
                                          {20, RemoveBody{"wall"}, {}}};
  EXPECT_EQ(world.timeline, expected);
  const World again = parseWorld(toXml(world), "a.xml", errors);
  EXPECT_EQ(again.timeline, expected);
}

TEST(Intervention, OfAWorldFileThatIsFaultyIsReportedWithItsLine) {
  const auto faults = [](const std::string& at) {
    ErrorList errors;
    parseWorld("<world><surface><size><xmin>0</xmin><xmax>9</xmax><ymin>0</ymin><ymax>9</ymax></size></surface>\n" +
                   at + "</world>",
               "a.xml", errors);
    return errors.errors();
  };
  using Faults = std::vector<std::string>;
  EXPECT_EQ(faults("<at time=\"-1\"><remove name=\"a\"/></at>"),
            Faults{"a.xml:2: <at time=\"-1\">: must be at least 0; write a number there"});
  EXPECT_EQ(faults("<at time=\"1\"/>"), Faults{"a.xml:2: <at>: contains no change; add one, such as <place>"});
  EXPECT_EQ(
      faults("<at time=\"1\"><shut name=\"door\"/></at>"),
      Faults{"a.xml:2: <shut>: is no change of a run; changes are: activity, add, change, communication, end, open, "
             "place, remove"});
  EXPECT_EQ(faults("<at time=\"1\"><add><robot model=\"scout\" name=\"a/b\" x=\"1\" y=\"2\"/></add></at>").size(), 1u);
  EXPECT_EQ(faults("<at time=\"1\"><add/></at>"),
            Faults{"a.xml:2: <add>: contains neither a <cylinder> nor a <cube> nor a <robot>; add one"});
  EXPECT_EQ(faults("<at time=\"1\"><place name=\"a\" x=\"1\" y=\"2\" z=\"3\"/></at>"),
            Faults{"a.xml:2: <place>: unknown attribute z=\"3\"; accepted here are: name, x, y"});
}

TEST(Intervention, IsRefusedWhenXmlCannotContainItsTexts) {
  EXPECT_EQ(faultOf(EndRun{"goal", "a\x01"}).empty(), false);
  EXPECT_EQ(faultOf(EndRun{" goal "}),
            "a text of it has characters that XML cannot contain, or spaces around it; leave them out");
  EXPECT_TRUE(faultOf(EndRun{std::string(101, 'x')}).ends_with("has 101 bytes; the most is 100"));
}

}  // namespace
}  // namespace robosim
