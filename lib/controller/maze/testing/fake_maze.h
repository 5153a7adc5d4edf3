#pragma once
#include <cmath>
#include <utility>
#include <vector>

#include "control/testing/fake_hardware.h"
#include "geometry/shapes/ray.h"
#include "geometry/shapes/solid.h"

namespace robosim {

/// A FakeHardware among walls for closed-loop tests: its sonars are single rays, walls block it, and gold at one point
/// emits heat by the linear law. The frame is the robot's start.
class FakeMaze {
 public:
  FakeMaze(std::vector<OrientedBox> walls, mrpt::math::TPoint2D gold, double gold_heat, int sonars = 32)
      : hardware(sonars), walls_(std::move(walls)), gold_(gold), gold_heat_(gold_heat) {
    hardware.sense = [this](FakeHardware&) { sense(); };
    sense();
  }

  /// Four walls around [x_min, x_max] × [y_min, y_max].
  static std::vector<OrientedBox> room(double x_min, double x_max, double y_min, double y_max) {
    const double x = (x_min + x_max) / 2, y = (y_min + y_max) / 2;
    return {box(x, y_min, x_max - x_min, 0.1), box(x, y_max, x_max - x_min, 0.1), box(x_min, y, 0.1, y_max - y_min),
            box(x_max, y, 0.1, y_max - y_min)};
  }
  static OrientedBox box(double x, double y, double length_x, double length_y) {
    return OrientedBox::from({x, y, 0}, length_x, length_y);
  }

  const mrpt::math::TPose2D& pose() const { return hardware.odometry().odom_from_robot; }

  FakeHardware hardware;

 private:
  void sense() {
    stopAtWalls();
    const auto& sonar = (*hardware.info().sensors)[1];
    for (std::size_t i = 0; i < sonar.beams.size(); ++i) {
      const auto& mount = sonar.beams[i].robot_from_beam;
      const auto from = pose().composePoint({mount.x, mount.y});
      const Ray ray = Ray::towards({from.x, from.y, 0.2}, pose().phi + mount.yaw);
      double nearest = 1e9;
      for (const auto& wall : walls_) {
        if (const auto hit = intersect(ray, Solid{wall, {0, 1}})) nearest = std::min(nearest, *hit);
      }
      hardware.setSonarRange(i, nearest);
    }
    const double away = std::hypot(pose().x - gold_.x, pose().y - gold_.y);
    hardware.setHeat(gold_heat_ * std::max(0.0, 1 - away / (*hardware.info().sensors)[3].range_max_m));
  }

  void stopAtWalls() {
    Odometry& odometry = hardware.mutableOdometry();
    mrpt::math::TPose2D& now = odometry.odom_from_robot;
    for (const auto& wall : walls_) {
      if (distance(wall, {now.x, now.y}) >= FakeHardware::kRadius_m) continue;
      now.x = last_.x;
      now.y = last_.y;
      odometry.speed_mps = 0;
      hardware.mutableReadings().stalled = true;
    }
    last_ = now;
  }

  std::vector<OrientedBox> walls_;
  mrpt::math::TPoint2D gold_;
  double gold_heat_;
  mrpt::math::TPose2D last_;
};

}  // namespace robosim
