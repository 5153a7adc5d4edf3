#pragma once
#include "sensors/registry.h"

namespace robosim {

/// Two paddles in front of a robot that close on an object between them (doc/moving_objects.md). They are no bodies:
/// nothing senses them or meets them.
struct GripperOptions {
  double front_m = 0;      ///< distance of the paddles' near ends from the robot's centre: its radius
  double reach_m = 0.1;    ///< length of the paddles, (0, 10]
  double opening_m = 0.2;  ///< distance between the open paddles, (0, 10]
  double z_m = 0.04;       ///< height of the paddles above the ground, [0, 10]
  bool operator==(const GripperOptions&) const = default;

  /// Whether a disc is between the open paddles: it is no wider than their distance, and its centre not beyond their
  /// tips.
  /// @param center robot frame
  bool isBetweenPaddles(const mrpt::math::TPoint2D& center, double radius_m) const;
};

/// Reads <gripper>: whether it is closed, whether it holds an object, and its light barriers (GripperState).
std::unique_ptr<Sensor> readGripper(XmlReader&, const Mount&);
/// Of a sensor; null for one that is no gripper.
const GripperOptions* gripperOptionsOf(const Sensor&);

}  // namespace robosim
