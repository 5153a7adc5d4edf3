#include "base/activmedia_text.h"

#include <functional>

#include <gtest/gtest.h>

#include "base/error_list.h"

namespace robosim {
namespace {

using Section = ActivmediaText::Section;

TEST(ActivmediaText, ReadsTheRecordsOfItsSections) {
  const std::string path = "a.map";
  ActivmediaText text(
      "2d-map \r\nCairn: Goal 1 2 90 \"\" ICON \"the end\"\n\nLINES\n-1 2 3.5 4 5\nNumPoints: 1\nLaser_DATA\n7 8\n",
      path);
  ASSERT_TRUE(text.next());
  EXPECT_EQ(text.section(), Section::metadata);
  EXPECT_EQ(text.words(), (std::vector<std::string>{"Cairn:", "Goal", "1", "2", "90", "", "ICON", "the end"}));
  ASSERT_TRUE(text.next());
  EXPECT_EQ(text.section(), Section::lines);
  EXPECT_EQ(text.readLine(), (std::array<double, 4>{-1, 2, 3.5, 4}));
  ASSERT_TRUE(text.next());
  EXPECT_EQ(text.section(), Section::metadata);  // also between the lines
  ASSERT_TRUE(text.next());
  EXPECT_EQ(text.section(), Section::points);
  EXPECT_EQ(text.readPoint(), (std::array<double, 2>{7, 8}));
  EXPECT_EQ(text.number(), 8);
  EXPECT_FALSE(text.next());
}

std::string errorOf(const std::function<void()>& read) {
  try {
    read();
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "";
}

TEST(ActivmediaText, ReportsFaultsWithTheirLine) {
  const std::string path = "a.map";
  EXPECT_EQ(errorOf([&] { ActivmediaText("", path); }),
            "a.map:1: is not an ActivMedia map: its first line is not 2D-Map");
  ActivmediaText text("2D-Map\nDATA\n1 x\n2e9 0\n", path);
  text.next();
  EXPECT_EQ(errorOf([&] { text.readPoint(); }), "a.map:3: '1 x' is not a point, x y in millimetres");
  text.next();
  EXPECT_EQ(errorOf([&] { text.readPoint(); }),
            "a.map:4: lies more than 1,000 km from the origin; coordinates are in millimetres");
}

}  // namespace
}  // namespace robosim
