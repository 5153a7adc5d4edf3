#include "base/nearest_name.h"

#include <gtest/gtest.h>

namespace robosim {
namespace {

using Names = std::vector<std::string>;

TEST(NearestName, HasTheLeastEditDistance) {
  EXPECT_EQ(nearestName("--tiem", Names{"--threads", "--time", "--team"}), "--time") << "one exchange of letters";
  EXPECT_EQ(nearestName("stutus", Names{"start", "status", "stop"}), "status");
  EXPECT_EQ(nearestName("pionier3dx", Names{"p3dx", "pioneer3dx"}), "pioneer3dx");
}

TEST(NearestName, IsNoneForAnotherWord) {
  EXPECT_EQ(nearestName("--frobnicate", Names{"--threads", "--time"}), std::nullopt);
  EXPECT_EQ(nearestName("x", Names{}), std::nullopt);
  EXPECT_EQ(nearestName(std::string(1'000'000, 'x'), Names{"x"}), std::nullopt);
}

TEST(NearestName, IsAskedFor) {
  EXPECT_EQ(didYouMean("scuot", Names{"scout", "pioneer3dx"}), "; did you mean scout?");
  EXPECT_EQ(didYouMean("tortoise", Names{"scout"}), "");
}

}  // namespace
}  // namespace robosim
