#include "maze/pose_filter.h"

#include <cmath>

#include <mrpt/math/wrap2pi.h>

#include "base/angle_units.h"
#include "base/portable_math.h"
#include "base/portable_pose.h"

namespace robosim {
namespace {

// Expected errors before any measurement.
constexpr double kTurnScaleStd = 0.03, kCurvatureStd_radpm = 0.01;
constexpr double kDeviationStd_rad = 20 * kRadPerDeg;
constexpr double kHardIronStd_rad = 5 * kRadPerDeg, kSoftIronStd_rad = 2 * kRadPerDeg;
constexpr double kCompassStd_rad = 3 * kRadPerDeg;
// Random errors of the odometry, as variances per metre and per radian.
constexpr double kPlaceVariance_per_m = 0.03 * 0.03;
constexpr double kHeadingVariance_per_m = 0.012 * 0.012;
constexpr double kHeadingVariance_per_rad = 0.022 * 0.022;
constexpr double kOutlier = 2;  // beyond that many standard deviations a measurement loses weight (Huber)

constexpr double square(double x) { return x * x; }

}  // namespace

PoseFilter::PoseFilter(const mrpt::math::TPose2D& map_from_start) : pose_(map_from_start) {
  covariance_[kTurnScale][kTurnScale] = square(kTurnScaleStd);
  covariance_[kCurvature][kCurvature] = square(kCurvatureStd_radpm);
}

void PoseFilter::move(const mrpt::math::TPose2D& motion) {
  const mrpt::math::TPose2D before = pose_;
  const double distance_m = portable::hypot(motion.x, motion.y) * (motion.x < 0 ? -1 : 1);
  pose_ = portable::compose(before, motion);
  pose_.phi += state_[kTurnScale] * motion.phi + state_[kCurvature] * distance_m;
  pose_.phi = mrpt::math::wrapToPi(pose_.phi);
  const double by_x = -(pose_.y - before.y), by_y = pose_.x - before.x;
  auto& p = covariance_;
  const auto transform = [&](auto&& at) {
    for (std::size_t j = 0; j < kStates; ++j) {
      at(kX, j) += by_x * at(kPhi, j);
      at(kY, j) += by_y * at(kPhi, j);
      at(kPhi, j) += motion.phi * at(kTurnScale, j) + distance_m * at(kCurvature, j);
    }
  };
  transform([&](std::size_t i, std::size_t j) -> double& { return p[i][j]; });
  transform([&](std::size_t i, std::size_t j) -> double& { return p[j][i]; });
  p[kX][kX] += kPlaceVariance_per_m * std::abs(distance_m);
  p[kY][kY] += kPlaceVariance_per_m * std::abs(distance_m);
  p[kPhi][kPhi] += kHeadingVariance_per_m * std::abs(distance_m) + kHeadingVariance_per_rad * std::abs(motion.phi);
}

void PoseFilter::turnTo(double compass_rad) {
  if (!has_compass_) {
    has_compass_ = true;
    state_[kA] = mrpt::math::wrapToPi(compass_rad - pose_.phi);
    covariance_[kA][kA] = square(kDeviationStd_rad);
    covariance_[kB][kB] = covariance_[kC][kC] = square(kHardIronStd_rad);
    covariance_[kD][kD] = covariance_[kE][kE] = square(kSoftIronStd_rad);
  }
  const auto once = portable::sincos(compass_rad), twice = portable::sincos(2 * compass_rad);
  Row slope{};
  slope[kPhi] = slope[kA] = 1;
  slope[kB] = once.sin;
  slope[kC] = once.cos;
  slope[kD] = twice.sin;
  slope[kE] = twice.cos;
  double expected = pose_.phi;
  for (std::size_t i = kA; i < kStates; ++i) expected += slope[i] * state_[i];
  measure(slope, mrpt::math::wrapToPi(compass_rad - expected), kCompassStd_rad);
}

void PoseFilter::correct(const std::array<double, 3>& slope, double off, double std) {
  Row row{};
  for (std::size_t i = 0; i < slope.size(); ++i) row[i] = slope[i];
  measure(row, off, std);
}

void PoseFilter::measure(const Row& slope, double off, double std) {
  Row gain{};
  double variance = 0;
  for (std::size_t i = 0; i < kStates; ++i) {
    for (std::size_t j = 0; j < kStates; ++j) gain[i] += covariance_[i][j] * slope[j];
    variance += slope[i] * gain[i];
  }
  double noise = square(std);
  const double scaled = std::abs(off) / std::sqrt(variance + noise);
  if (scaled > kOutlier) noise = (variance + noise) * scaled / kOutlier - variance;
  variance += noise;
  Row step{};
  for (std::size_t i = 0; i < kStates; ++i) step[i] = gain[i] / variance * off;
  for (std::size_t i = 0; i < kStates; ++i) {
    for (std::size_t j = 0; j < kStates; ++j) covariance_[i][j] -= gain[i] * gain[j] / variance;
  }
  pose_.x += step[kX];
  pose_.y += step[kY];
  pose_.phi = mrpt::math::wrapToPi(pose_.phi + step[kPhi]);
  for (std::size_t i = kTurnScale; i < kStates; ++i) state_[i] += step[i];
}

}  // namespace robosim
