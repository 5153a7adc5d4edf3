#include "rendering/blob_search.h"

#include <algorithm>
#include <cmath>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

namespace robosim {
namespace {

/// Mask of the pixels that have the colour. `hsv` holds hue (0 … 255 for a full turn), saturation and value.
cv::Mat computeMask(const cv::Mat& hsv, const TargetColor& color) {
  const double unit = 256 / (2 * M_PI);
  const int low = static_cast<int>(std::lround((color.hue_rad - color.within_rad) * unit));
  const int high = static_cast<int>(std::lround((color.hue_rad + color.within_rad) * unit));
  const double saturation = 255 * color.saturation_min, value = 255 * color.value_min;
  const auto between = [&](int from, int to) {
    cv::Mat mask;
    cv::inRange(hsv, cv::Scalar(from, saturation, value), cv::Scalar(to, 255, 255), mask);
    return mask;
  };
  if (high - low >= 255) return between(0, 255);
  cv::Mat mask = between(std::max(low, 0), std::min(high, 255));
  if (low < 0) mask |= between(low + 256, 255);
  if (high > 255) mask |= between(0, high - 256);
  return mask;
}

Blob largestIn(const cv::Mat& mask, unsigned pixels_min) {
  cv::Mat labels, stats, centroids;
  const int count = cv::connectedComponentsWithStats(mask, labels, stats, centroids, 8, CV_32S);
  int best = 0;
  for (int i = 1; i < count; ++i) {
    if (best == 0 || stats.at<int>(i, cv::CC_STAT_AREA) > stats.at<int>(best, cv::CC_STAT_AREA)) best = i;
  }
  const auto stat = [&](int which) { return static_cast<std::uint32_t>(stats.at<int>(best, which)); };
  if (best == 0 || stat(cv::CC_STAT_AREA) < pixels_min) return {};
  return {.color = {},
          .pixels = stat(cv::CC_STAT_AREA),
          .x_px = static_cast<float>(centroids.at<double>(best, 0)),
          .y_px = static_cast<float>(centroids.at<double>(best, 1)),
          .left_px = stat(cv::CC_STAT_LEFT),
          .top_px = stat(cv::CC_STAT_TOP),
          .width_px = stat(cv::CC_STAT_WIDTH),
          .height_px = stat(cv::CC_STAT_HEIGHT)};
}

}  // namespace

std::vector<Blob> findBlobs(const std::string& jpeg, const std::vector<TargetColor>& colors, unsigned pixels_min) {
  std::vector<Blob> blobs(colors.size());
  const cv::Mat bytes(1, static_cast<int>(jpeg.size()), CV_8U, const_cast<char*>(jpeg.data()));
  const cv::Mat picture = jpeg.empty() ? cv::Mat() : cv::imdecode(bytes, cv::IMREAD_COLOR);
  cv::Mat hsv;
  if (!picture.empty()) cv::cvtColor(picture, hsv, cv::COLOR_BGR2HSV_FULL);
  for (std::size_t i = 0; i < colors.size(); ++i) {
    if (!hsv.empty()) blobs[i] = largestIn(computeMask(hsv, colors[i]), pixels_min);
    blobs[i].color = colors[i].name;
  }
  return blobs;
}

}  // namespace robosim
