#include "topics/frame_tree.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace robosim {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;

/// A frame that is moved, and not turned.
ros::TransformStamped transformAt(std::int32_t time_s, const std::string& parent, const std::string& child, double x_m,
                                  double y_m = 0) {
  return {{{time_s, 0}, parent}, child, {{x_m, y_m, 0}, {0, 0, 0, 1}}};
}

/// x and y of a frame; NaN for an unknown one.
std::pair<double, double> at(const FrameTree& frames, const std::string& in, const std::string& frame,
                             double time_s = 0) {
  const auto pose = frames.find(in, frame, static_cast<std::int64_t>(time_s * 1e9));
  return pose ? std::pair(pose->x(), pose->y()) : std::pair<double, double>(NAN, NAN);
}
using XY = std::pair<double, double>;

TEST(FrameTree, ComposesTheTransformsOfAChain) {
  FrameTree frames;
  ros::TransformStamped turned = transformAt(0, "base_link", "mast", 0.5);
  turned.transform.rotation = {0, 0, std::sqrt(0.5), std::sqrt(0.5)};  // 90° about z
  frames.add(turned, 0, true);
  frames.add(transformAt(0, "mast", "laser", 0.25), 0, true);
  const auto pose = frames.find("base_link", "laser", 0);
  ASSERT_TRUE(pose);
  EXPECT_NEAR(pose->x(), 0.5, 1e-15);
  EXPECT_NEAR(pose->y(), 0.25, 1e-15);
  EXPECT_DOUBLE_EQ(pose->yaw(), M_PI / 2);
}

TEST(FrameTree, FindsFramesBelowACommonOne) {
  FrameTree frames;
  frames.add(transformAt(0, "base_footprint", "base_link", 1), 0, true);
  frames.add(transformAt(0, "base_footprint", "laser", 3, 2), 0, true);
  EXPECT_EQ(at(frames, "base_link", "laser"), XY(2, 2));
  EXPECT_EQ(at(frames, "laser", "base_link"), XY(-2, -2));
  EXPECT_EQ(at(frames, "base_link", "base_footprint"), XY(-1, 0));
  EXPECT_EQ(at(frames, "laser", "laser"), XY(0, 0));
}

TEST(FrameTree, UsesTheLatestTransformThatIsNotLater) {
  FrameTree frames;
  for (const int second : {2, 1, 3}) frames.add(transformAt(second, "/base", "/head", second), second * kSecond, false);
  frames.sort();
  EXPECT_EQ(at(frames, "base", "head", 2.5), XY(2, 0));
  EXPECT_EQ(at(frames, "base", "head", 3), XY(3, 0));
  EXPECT_EQ(at(frames, "base", "head", 0.5), XY(1, 0)) << "the first one";
  EXPECT_EQ(frames.posesOf("head").size(), 3u);
  frames.add(transformAt(0, "base", "head", 7), 0, true);
  EXPECT_EQ(at(frames, "base", "head", 3), XY(7, 0)) << "a static one is valid at all times";
}

TEST(FrameTree, DoesNotRepeatPoses) {
  FrameTree frames;
  for (const int second : {1, 2, 3}) frames.add(transformAt(second, "base", "wheel", 1), second * kSecond, false);
  EXPECT_EQ(frames.posesOf("wheel").size(), 1u);
}

TEST(FrameTree, DoesNotFindWhatTransformsDoNotConnect) {
  FrameTree frames;
  frames.add(transformAt(0, "base", "laser", 1), 0, true);
  frames.add(transformAt(0, "other", "camera", 1), 0, true);
  EXPECT_FALSE(frames.find("base", "camera", 0));
  EXPECT_FALSE(frames.find("base", "unknown", 0));
  EXPECT_TRUE(frames.contains("other"));
  EXPECT_FALSE(frames.contains("unknown"));
}

TEST(FrameTree, EndsInACycleAndLeavesOutWhatIsNotFinite) {
  FrameTree frames;
  frames.add(transformAt(0, "a", "b", 1), 0, true);
  frames.add(transformAt(0, "b", "a", 1), 0, true);
  EXPECT_FALSE(frames.find("a", "c", 0));
  frames.find("c", "b", 0);
  frames.add(transformAt(0, "a", "n", std::numeric_limits<double>::quiet_NaN()), 0, true);
  EXPECT_FALSE(frames.contains("n"));
}

TEST(FrameTree, TakesARotationOfLength0ForNone) { EXPECT_EQ(toPose(ros::Vector3{1, 2, 3}, {0, 0, 0, 0}).yaw(), 0); }

}  // namespace
}  // namespace robosim
