#include "wire/plausible_echoes.h"

#include <limits>

#include <gtest/gtest.h>

namespace robosim {
namespace {

/// A sonar 0.1 m ahead of the robot's centre that looks along x, from 0.2 to 5 m; 6 m stand for nothing in range.
SensorInfo sonar() {
  SensorInfo info;
  info.label = "sonar";
  info.beams = {{{0.1, 0, 0, 0, 0, 0}}};
  info.range_min_m = 0.2;
  info.range_max_m = 5;
  info.no_echo_m = 6;
  return info;
}

TEST(PlausibleEchoes, AcceptPossibleMeasurements) {
  EXPECT_EQ(faultOf(Echoes{{2, {2.1f, 0, 0}}}, sonar()), "");
  EXPECT_EQ(faultOf(Echoes{{6, {6.1f, 0, 0}}}, sonar()), "") << "nothing in range";
  EXPECT_EQ(faultOf(Echoes{{0.2f, {0.15f, 0, 0}}}, sonar()), "") << "nearer than the minimum";
}

TEST(PlausibleEchoes, RefuseImpossibleRanges) {
  const float infinity = std::numeric_limits<float>::infinity();
  for (const float range_m : {-5.f, 0.f, 0.19f, 5.1f, 6.1f, 1e30f, infinity, -infinity}) {
    EXPECT_NE(faultOf(Echoes{{range_m, {0.1f + range_m, 0, 0}}}, sonar()), "") << range_m;
  }
  EXPECT_EQ(
      faultOf(Echoes{{-5, {-4.9f, 0, 0}}}, sonar()),
      "sonar, beam 0: a range of -5.000000 m; it must lie in [0.200000, 5.000000] m, or be 6.000000 m where nothing "
      "is in range");
}

TEST(PlausibleEchoes, RefusePointsThatAreNotAtTheRange) {
  const float infinity = std::numeric_limits<float>::infinity();
  for (const float x_m : {2.f, 2.2f, -4.f, 1e30f, infinity}) {
    EXPECT_NE(faultOf(Echoes{{2, {x_m, 0, 0}}}, sonar()), "") << x_m;
  }
  EXPECT_NE(faultOf(Echoes{{0.2f, {0.5f, 0, 0}}}, sonar()), "");
}

}  // namespace
}  // namespace robosim
