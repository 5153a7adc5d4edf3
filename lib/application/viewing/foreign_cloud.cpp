#include "viewing/foreign_cloud.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationVelodyneScan.h>

#include "world/occupancy_grid.h"

namespace robosim {
namespace {

using mrpt::obs::CObservation3DRangeScan;
using mrpt::obs::CObservationVelodyneScan;

/// Maximum number of points; more would only slow down drawing.
constexpr std::size_t kMaxPoints = 6000;

/// Collects the points of a cloud that are finite and within reach, in the robot's frame.
class Cloud {
 public:
  explicit Cloud(const mrpt::poses::CPose3D& robot_from_sensor) : robot_from_sensor_(robot_from_sensor) {}
  void add(double x_m, double y_m, double z_m) {
    const auto at = robot_from_sensor_.composePoint({x_m, y_m, z_m});
    const double range_m = std::hypot(x_m, y_m, z_m);
    const bool is_on_map = std::abs(at.x) <= kMapReach_m && std::abs(at.y) <= kMapReach_m && std::isfinite(at.z);
    if (!(range_m > 0 && range_m <= kMapReach_m) || !is_on_map) return;
    echoes_.push_back(
        {static_cast<float>(range_m), {static_cast<float>(at.x), static_cast<float>(at.y), static_cast<float>(at.z)}});
  }
  Echoes take() { return std::move(echoes_); }

 private:
  mrpt::poses::CPose3D robot_from_sensor_;
  Echoes echoes_;
};

/// Of the depth image, by the pinhole model of its camera; else the points that the observation contains.
Echoes pointsOf(const CObservation3DRangeScan& scan) {
  Cloud cloud(scan.sensorPose);
  if (scan.hasRangeImage && scan.rangeImage.size() > 0) {
    const double focal_x = scan.cameraParams.fx(), focal_y = scan.cameraParams.fy();
    const auto pixels = static_cast<double>(scan.rangeImage.size());
    const auto stride = static_cast<long>(std::ceil(std::sqrt(std::max(1.0, pixels / kMaxPoints))));
    for (long row = 0; row < scan.rangeImage.rows(); row += stride) {
      for (long column = 0; column < scan.rangeImage.cols(); column += stride) {
        const double left = (scan.cameraParams.cx() - static_cast<double>(column)) / focal_x;
        const double up = (scan.cameraParams.cy() - static_cast<double>(row)) / focal_y;
        const double measured_m = scan.rangeImage(row, column) * static_cast<double>(scan.rangeUnits);
        const double ahead_m = scan.range_is_depth ? measured_m : measured_m / std::hypot(1, left, up);
        cloud.add(ahead_m, left * ahead_m, up * ahead_m);
      }
    }
  } else if (scan.hasPoints3D) {
    const std::size_t count = std::min({scan.points3D_x.size(), scan.points3D_y.size(), scan.points3D_z.size()});
    for (std::size_t i = 0; i < count; i += 1 + count / kMaxPoints) {
      cloud.add(scan.points3D_x[i], scan.points3D_y[i], scan.points3D_z[i]);
    }
  }
  return cloud.take();
}

Echoes pointsOf(const CObservationVelodyneScan& scan) {
  Cloud cloud(scan.sensorPose);
  CObservationVelodyneScan copy(scan);
  try {
    if (copy.point_cloud.x.empty()) copy.generatePointCloud();
  } catch (const std::exception&) {
    return {};  // without its calibration, or of an unknown model
  }
  const auto& points = copy.point_cloud;
  const std::size_t count = std::min({points.x.size(), points.y.size(), points.z.size()});
  for (std::size_t i = 0; i < count; i += 1 + count / kMaxPoints) cloud.add(points.x[i], points.y[i], points.z[i]);
  return cloud.take();
}

}  // namespace

bool isCloud(const mrpt::obs::CObservation& observation) {
  return dynamic_cast<const CObservation3DRangeScan*>(&observation) ||
         dynamic_cast<const CObservationVelodyneScan*>(&observation);
}

Echoes pointsOf(const mrpt::obs::CObservation& observation) {
  if (const auto* scan = dynamic_cast<const CObservation3DRangeScan*>(&observation)) return pointsOf(*scan);
  return pointsOf(dynamic_cast<const CObservationVelodyneScan&>(observation));
}

}  // namespace robosim
