#include "base/label.h"

#include <gtest/gtest.h>

namespace robosim {
namespace {

TEST(Label, HasRobotSensorAndPart) {
  EXPECT_EQ(Label::parse("SICK"), (Label{"", "SICK", ""}));
  EXPECT_EQ(Label::parse(""), (Label{"", "", ""}));
  EXPECT_EQ(Label::parse("r1/sonar"), (Label{"r1", "sonar", ""}));
  EXPECT_EQ(Label::parse("r1/sonar/POINTS"), (Label{"r1", "sonar", "POINTS"}));
  EXPECT_EQ(Label::parse("r1/a/b/c"), (Label{"r1", "a", "b/c"}));
}

TEST(Label, IsPrintedAsParsed) {
  for (const char* text : {"SICK", "", "r1/sonar", "r1/sonar/POINTS", "r1/a/b/c"}) {
    EXPECT_EQ(Label::parse(text).text(), text);
  }
  EXPECT_EQ(Label::parse("r1/sonar/POINTS").withinRobot(), "sonar/POINTS");
  EXPECT_EQ(Label::parse("r1/sonar").withinRobot(), "sonar");
}

TEST(Label, RejectsReservedSensorLabelsAndSlashes) {
  EXPECT_EQ(sensorLabelError("sonar"), "");
  EXPECT_EQ(sensorLabelError("status"), "");
  for (const char* reserved : {"GROUND_TRUTH", "STATUS", "INBOX", "POINTS"}) {
    EXPECT_EQ(sensorLabelError(reserved),
              "is reserved for recordings (GROUND_TRUTH, STATUS, INBOX, POINTS); choose another label");
  }
  EXPECT_EQ(sensorLabelError("left/sonar"),
            "must not contain '/', which separates robot and sensor in a recording; choose another label");
  EXPECT_EQ(robotNameError("STATUS"), "");
  EXPECT_EQ(robotNameError("left/robot"),
            "must not contain '/', which separates robot and sensor in a recording; choose another name");
}

}  // namespace
}  // namespace robosim
