#include "rendering/canvas.h"

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

namespace robosim {
namespace {

TEST(Canvas, DrawsADiscAboutItsCentre) {
  Canvas canvas(GroundView(41, 41, {0, 0}, 1), {0, 0, 0});
  canvas.disc({20, 18}, 10, {1, 1, 1});
  const cv::Mat picture = canvas.picture();
  double sum = 0, sum_x = 0, sum_y = 0;
  for (int row = 0; row < picture.rows; ++row) {
    for (int column = 0; column < picture.cols; ++column) {
      const double brightness = picture.at<cv::Vec3b>(row, column)[0];
      sum += brightness;
      sum_x += brightness * column;
      sum_y += brightness * row;
    }
  }
  // A quarter of a pixel is half of a fine pixel.
  EXPECT_NEAR(sum_x / sum, 20, 0.1);
  EXPECT_NEAR(sum_y / sum, 18, 0.1);
}

}  // namespace
}  // namespace robosim
