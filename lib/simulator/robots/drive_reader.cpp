#include "robots/drive_reader.h"

#include "base/angle_units.h"

namespace robosim {

Drive readDrive(XmlReader& reader, MotionLimits& limits) {
  Drive drive;
  drive.kind = reader.choice("type",
                             {{nameOf(DriveKind::differential), DriveKind::differential},
                              {nameOf(DriveKind::omni), DriveKind::omni},
                              {nameOf(DriveKind::car), DriveKind::car},
                              {nameOf(DriveKind::tracked), DriveKind::tracked}},
                             DriveKind::differential);
  limits.lateral_max_mps = 0;
  switch (drive.kind) {
    case DriveKind::differential:
      break;
    case DriveKind::omni:
      limits.lateral_max_mps = reader.number("lateral_max_mps", Bounds::positive(100), limits.speed_max_mps);
      break;
    case DriveKind::car:
      drive.wheelbase_m = reader.number("wheelbase_m", Bounds::positive(100));
      // Near 90° the tangent of the angle, and with it the turn rate, has no bounds.
      drive.steering_max_rad = kRadPerDeg * reader.number("steering_max_deg", Bounds::positive(85));
      drive.steering_rate_radps = kRadPerDeg * reader.number("steering_rate_degps", Bounds::notNegative(36000), 0);
      drive.icr_x_m = reader.number("rear_axle_x_m", {-10, 10}, drive.icr_x_m);
      break;
    case DriveKind::tracked:
      drive.track_factor = reader.number("track_factor", {1, 10}, drive.track_factor);
      drive.assumed_factor = reader.number("assumed_factor", {1, 10}, drive.assumed_factor);
      drive.icr_x_m = reader.number("icr_x_m", {-10, 10}, drive.icr_x_m);
      break;
  }
  reader.finish();
  return drive;
}

}  // namespace robosim
