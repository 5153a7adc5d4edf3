#include "rendering/outline_text.h"

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

namespace robosim {
namespace {

int covered(const std::string& text) {
  const auto drawn = drawOutlineText(text, 20);
  EXPECT_TRUE(drawn) << "install a font, such as the package fonts-dejavu-core";
  return drawn ? cv::countNonZero(drawn->coverage) : 0;
}

TEST(OutlineText, IsNeededForCharactersOutsideAscii) {
  EXPECT_FALSE(needsOutlineFont("Rover 1~"));
  EXPECT_TRUE(needsOutlineFont("Jürgen"));
}

TEST(OutlineText, DrawsEveryCharacterAsOneGlyph) {
  const auto drawn = drawOutlineText("H", 20);
  ASSERT_TRUE(drawn);
  EXPECT_NEAR(drawn->baseline_px, 20, 2) << "the foot of a capital is on the baseline";
  EXPECT_EQ(drawn->coverage.rows, drawn->baseline_px);
  EXPECT_GT(covered("ü"), covered("u")) << "the dots";
  const auto one = drawOutlineText("Ä", 20), two = drawOutlineText("ÄÄ", 20);
  EXPECT_NEAR(two->coverage.cols, 2 * one->coverage.cols, 4) << "one glyph per character, not per byte";
}

TEST(OutlineText, DrawsInvalidUtf8AsAReplacementCharacter) { EXPECT_GT(covered("\xff"), 0); }

}  // namespace
}  // namespace robosim
