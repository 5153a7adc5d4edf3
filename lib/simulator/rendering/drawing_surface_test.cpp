#include "rendering/drawing_surface.h"

#include <cmath>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace robosim {
namespace {

using mrpt::math::TPoint2D;

constexpr Color kDark{0, 0, 0}, kBright{1, 1, 1}, kSignal{1, 0, 0};
const GroundView kSquare(41, 41, {0, 0}, 1);

cv::Vec3b pixelAt(const DrawingSurface& surface, int x, int y) { return surface.picture().at<cv::Vec3b>(y, x); }

/// Number of pixels that differ from a white background.
int inked(const DrawingSurface& surface) {
  cv::Mat grey;
  cv::cvtColor(surface.picture(), grey, cv::COLOR_BGR2GRAY);
  return cv::countNonZero(grey < 255);
}

/// Area and centre of what is white on black.
cv::Moments momentsOf(const DrawingSurface& surface) {
  cv::Mat grey;
  cv::cvtColor(surface.picture(), grey, cv::COLOR_BGR2GRAY);
  return cv::moments(grey);
}

TEST(DrawingSurface, DrawsDiscsAndDotsAboutTheirCentresWithTheirAreas) {
  for (const double scale : {1.0, 2.0}) {
    for (const TPoint2D& center : {TPoint2D(20, 18), TPoint2D(20.3, 18.6)}) {
      for (const bool is_dot : {false, true}) {
        DrawingSurface surface(kSquare, kDark, scale);
        const double radius_px = is_dot ? 3 : 10;
        if (is_dot) surface.dot(center, radius_px, kBright);
        if (!is_dot) surface.disc(center, radius_px, kBright);
        const cv::Moments moments = momentsOf(surface);
        // (0, 0) is the middle of the view's first pixel, also at scale 2.
        EXPECT_NEAR(moments.m10 / moments.m00, (center.x + 0.5) * scale - 0.5, 0.05);
        EXPECT_NEAR(moments.m01 / moments.m00, (center.y + 0.5) * scale - 0.5, 0.05);
        const double area_px2 = M_PI * radius_px * radius_px * scale * scale;
        EXPECT_NEAR(moments.m00 / 255, area_px2, 0.03 * area_px2) << scale << (is_dot ? " dot" : " disc");
      }
    }
  }
}

TEST(DrawingSurface, CutsDotsOffAtTheEdgesOfThePicture) {
  DrawingSurface surface(kSquare, kDark);
  surface.dot({-0.5, 20}, 4, kBright);
  surface.dot({40.5, 40.5}, 4, kBright);
  surface.dot({-100, 1e6}, 4, kBright);
  EXPECT_NEAR(momentsOf(surface).m00 / 255, M_PI * 16 * (0.5 + 0.25), 1.5);
}

TEST(DrawingSurface, FillsTheUnionOfPolygonsOfAnyDirectionOnce) {
  DrawingSurface surface(kSquare, kBright);
  surface.fillUnion(std::vector<std::vector<TPoint2D>>{{{5, 5}, {25, 5}, {25, 25}, {5, 25}},
                                                       {{15, 15}, {15, 35}, {35, 35}, {35, 15}}},
                    kSignal, 0.5);
  const cv::Vec3b half(128, 128, 255);
  for (const auto& [x, y] : {std::pair{10, 10}, std::pair{20, 20}, std::pair{30, 30}}) {
    EXPECT_LE(cv::norm(pixelAt(surface, x, y), half, cv::NORM_INF), 1) << x;
  }
  EXPECT_EQ(pixelAt(surface, 30, 10), cv::Vec3b(255, 255, 255));
}

TEST(DrawingSurface, FillsWhatIsLeftOfAMask) {
  DrawingSurface surface(kSquare, kBright);
  cv::Mat coverage =
      surface.coverage(std::vector<std::vector<TPoint2D>>{{{4.5, 4.5}, {24.5, 4.5}, {24.5, 24.5}, {4.5, 24.5}}});
  ASSERT_EQ(coverage.size(), cv::Size(41, 41));
  EXPECT_EQ(cv::countNonZero(coverage == 255), 20 * 20) << "whole pixels";
  EXPECT_EQ(cv::countNonZero(coverage), 20 * 20);
  coverage.colRange(0, 15) = 0;
  surface.fillMask(coverage, kSignal, 1);
  EXPECT_EQ(pixelAt(surface, 14, 10), cv::Vec3b(255, 255, 255));
  EXPECT_EQ(pixelAt(surface, 15, 10), cv::Vec3b(0, 0, 255));
}

TEST(DrawingSurface, LaysATransparentLayerOverOtherDrawings) {
  DrawingSurface layer(kSquare, std::nullopt);
  layer.disc({20, 20}, 10, kSignal);
  DrawingSurface laid(kSquare, kBright), drawn(kSquare, kBright);
  for (DrawingSurface* surface : {&laid, &drawn}) surface->line({0, 20}, {40, 20}, 3, kDark);
  laid.lay(layer);
  drawn.disc({20, 20}, 10, kSignal);
  EXPECT_LE(cv::norm(laid.picture(), drawn.picture(), cv::NORM_INF), 2) << "rounding of colours at the edge";
}

TEST(DrawingSurface, CopiesShareNoPixels) {
  DrawingSurface first(kSquare, kBright);
  first.disc({10, 10}, 5, kDark);
  DrawingSurface second(first);
  EXPECT_EQ(pixelAt(second, 10, 10), cv::Vec3b(0, 0, 0));
  second.disc({30, 30}, 5, kDark);
  EXPECT_EQ(pixelAt(first, 30, 30), cv::Vec3b(255, 255, 255));
}

TEST(DrawingSurface, BeginsAsACopyOfAPicture) {
  cv::Mat picture(20, 30, CV_8UC3);
  cv::randu(picture, 0, 256);
  const DrawingSurface surface(picture);
  EXPECT_EQ(cv::norm(surface.picture(), picture, cv::NORM_INF), 0);
  EXPECT_EQ(surface.view().width(), 30);
  EXPECT_EQ(surface.view().height(), 20);
}

int inkOf(const std::string& text) {
  DrawingSurface surface(GroundView(300, 60, {0, 0}, 1), kBright);
  surface.text({10, 30}, text, 20, kDark);
  return inked(surface);
}

TEST(DrawingSurface, DrawsEveryCharacterAsOneGlyph) {
  EXPECT_GT(inkOf("u"), 0) << "install a font, such as the package fonts-dejavu-core";
  EXPECT_GT(inkOf("ü"), inkOf("u")) << "the dots";
  const DrawingSurface surface(kSquare, kBright);
  EXPECT_NEAR(surface.textWidth("ÄÄ", 20), 2 * surface.textWidth("Ä", 20), 0.1) << "one glyph per character, not byte";
  EXPECT_GT(inkOf("\xff"), 0) << "a replacement character for invalid UTF-8";
}

TEST(DrawingSurface, DrawsNothingOfATextOutsideThePicture) {
  DrawingSurface surface(kSquare, kBright);
  surface.text({500, 500}, "far away", 10, kDark);
  EXPECT_EQ(inked(surface), 0);
  EXPECT_EQ(surface.contrast({500, 520, 500, 520}), 0);
}

}  // namespace
}  // namespace robosim
