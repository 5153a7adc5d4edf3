#include "rendering/camera_effects.h"

#include <algorithm>
#include <cmath>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace robosim {
namespace {

/// Where a pinhole shows what the camera shows at the centre of a pixel, from the optical axis, at a distance of 1.
LensDistortion::Point toIdealPoint(const CameraInfo& info, double x_px, double y_px) {
  const double focal_px = info.focalLength();
  const LensDistortion::Point shown{(x_px + 0.5 - info.width_px / 2.0) / focal_px,
                                    (y_px + 0.5 - info.height_px / 2.0) / focal_px};
  LensDistortion::Point ideal = shown;
  if (!info.distortion.isNone() && !info.distortion.undistort(shown, ideal)) return shown;
  return ideal;
}

cv::Mat warped(const cv::Mat& pinhole, const CameraView& camera, double turn_radps) {
  const CameraInfo& info = camera.info;
  const double focal_px = info.focalLength();
  const int width = static_cast<int>(info.width_px), height = static_cast<int>(info.height_px);
  cv::Mat_<float> from_x(height, width), from_y(height, width);
  for (int y = 0; y < height; ++y) {
    // The robot has turned by this since the row was read.
    const double since_rad = turn_radps * camera.errors.rolling_shutter_s * (1 - (y + 0.5) / height);
    for (int x = 0; x < width; ++x) {
      auto ideal = toIdealPoint(info, x, y);
      if (since_rad != 0) ideal.x = std::tan(std::atan(ideal.x) + since_rad);
      from_x(y, x) = static_cast<float>(ideal.x * focal_px + pinhole.cols / 2.0 - 0.5);
      from_y(y, x) = static_cast<float>(ideal.y * focal_px + pinhole.rows / 2.0 - 0.5);
    }
  }
  cv::Mat picture;
  cv::remap(pinhole, picture, from_x, from_y, cv::INTER_LINEAR, cv::BORDER_CONSTANT);
  return picture;
}

}  // namespace

CameraInfo pinholeFor(const CameraView& camera, std::uint32_t multiple_px) {
  const CameraInfo& info = camera.info;
  if (info.distortion.isNone() && camera.errors.rolling_shutter_s == 0) return info;
  double right = 0, down = 0;
  for (std::uint32_t x = 0; x < info.width_px; ++x) {
    for (const double y : {0.0, info.height_px - 1.0}) down = std::max(down, std::abs(toIdealPoint(info, x, y).y));
  }
  for (std::uint32_t y = 0; y < info.height_px; ++y) {
    for (const double x : {0.0, info.width_px - 1.0}) right = std::max(right, std::abs(toIdealPoint(info, x, y).x));
  }
  // A turn of up to half a radian during the read-out.
  if (camera.errors.rolling_shutter_s > 0) right = std::tan(std::min(1.4, std::atan(right) + 0.5));
  const double focal_px = info.focalLength();
  const auto side = [&](double half, std::uint32_t side_min) {
    const double half_px = half * focal_px + 1;
    const auto px = multiple_px * static_cast<std::uint32_t>(std::ceil(2 * half_px / multiple_px));
    return std::min(kPictureSideMax_px, std::max(side_min, px + (side_min & 1)));
  };
  CameraInfo pinhole = info;
  pinhole.distortion = {};
  pinhole.width_px = side(right, info.width_px);
  pinhole.height_px = side(down, info.height_px);
  pinhole.field_of_view_rad = 2 * std::atan(pinhole.width_px / 2.0 / focal_px);
  return pinhole;
}

cv::Mat withCameraErrors(const cv::Mat& pinhole, const CameraView& camera, double turn_radps, std::uint64_t seed) {
  const CameraErrors& errors = camera.errors;
  const bool is_warped = !camera.info.distortion.isNone() || errors.rolling_shutter_s > 0;
  cv::Mat picture = is_warped ? warped(pinhole, camera, turn_radps) : pinhole;
  cv::RNG random(seed);
  const double exposure = errors.exposure * std::max(0.0, 1 + random.gaussian(errors.exposure_std));
  if (exposure != 1 || errors.noise_std > 0) {
    cv::Mat levels;
    picture.convertTo(levels, CV_32FC3, exposure);
    if (errors.noise_std > 0) {
      cv::Mat noise(levels.size(), CV_32FC3);
      random.fill(noise, cv::RNG::NORMAL, 0, errors.noise_std);
      levels = cv::min(levels, 255) + noise;
    }
    cv::Mat shown;  // `picture` may share the memory of `pinhole`
    levels.convertTo(shown, CV_8UC3);
    return shown;
  }
  return picture;
}

}  // namespace robosim
