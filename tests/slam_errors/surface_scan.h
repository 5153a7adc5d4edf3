#pragma once
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include <mrpt/math/TPoint2D.h>

#include "calibration/standing_scans.h"

namespace robosim {

/// Points and surfaces of a scan, in the scanner's frame. Points of adjacent beams are joined to a surface unless it
/// would be seen at more than 80° of incidence.
class SurfaceScan {
 public:
  struct Nearest {
    mrpt::math::TPoint2D foot, normal;
  };

  SurfaceScan(const ScanSeries& series, const std::vector<double>& ranges_m)
      : first_rad_(series.first_rad), step_rad_(series.step_rad), ranges_m_(ranges_m) {
    for (std::size_t i = 0; i < ranges_m.size(); ++i) {
      const double bearing_rad = first_rad_ + step_rad_ * static_cast<double>(i);
      points_.emplace_back(ranges_m[i] * std::cos(bearing_rad), ranges_m[i] * std::sin(bearing_rad));
    }
  }

  std::size_t size() const { return points_.size(); }
  /// nullopt for a beam without an echo
  std::optional<mrpt::math::TPoint2D> point(std::size_t i) const {
    return std::isnan(ranges_m_[i]) ? std::nullopt : std::optional(points_[i]);
  }
  /// Whether a point and the next one are on one surface.
  bool isJoined(std::size_t i) const {
    if (i + 1 >= ranges_m_.size()) return false;
    const double smaller_m = std::min(ranges_m_[i], ranges_m_[i + 1]);
    return std::abs(ranges_m_[i] - ranges_m_[i + 1]) <= 6 * smaller_m * step_rad_ + 0.03;  // false for NaN
  }

  /// The surface nearest to a point, nearer than `far_m`.
  std::optional<Nearest> nearest(const mrpt::math::TPoint2D& p, double far_m) const {
    const double range_m = std::hypot(p.x, p.y);
    const double middle = (std::atan2(p.y, p.x) - first_rad_) / step_rad_;
    const double half = std::asin(std::min(1.0, far_m / std::max(range_m, far_m))) / step_rad_ + 1;
    const double last = static_cast<double>(size()) - 1;
    if (middle + half < 0 || middle - half > last) return std::nullopt;
    const auto from = static_cast<std::size_t>(std::max(0.0, middle - half));
    const auto to = static_cast<std::size_t>(std::min(last, middle + half));
    std::optional<Nearest> found;
    double nearest_m2 = far_m * far_m;
    for (std::size_t i = from; i < to; ++i) {
      if (!isJoined(i)) continue;
      const mrpt::math::TPoint2D along = points_[i + 1] - points_[i], out = p - points_[i];
      const double length_m2 = along.x * along.x + along.y * along.y;
      if (length_m2 == 0) continue;
      const auto foot = points_[i] + along * std::clamp((out.x * along.x + out.y * along.y) / length_m2, 0.0, 1.0);
      const double off_m2 = (p.x - foot.x) * (p.x - foot.x) + (p.y - foot.y) * (p.y - foot.y);
      if (off_m2 >= nearest_m2) continue;
      nearest_m2 = off_m2;
      const double length_m = std::sqrt(length_m2);
      found = Nearest{foot, {-along.y / length_m, along.x / length_m}};
    }
    return found;
  }

 private:
  double first_rad_, step_rad_;
  std::vector<double> ranges_m_;
  std::vector<mrpt::math::TPoint2D> points_;
};

}  // namespace robosim
