#pragma once
#include <utility>

namespace robosim {

/// Arithmetic in ARIA's units, as its ArMath. Angles are in degrees, counter-clockwise. The functions give the same
/// result on every machine (base/portable_math.h).
struct Math {
  static double fixAngle(double deg);  ///< the equivalent angle in (-180, 180]
  static double addAngle(double deg1, double deg2) { return fixAngle(deg1 + deg2); }
  static double subAngle(double deg1, double deg2) { return fixAngle(deg1 - deg2); }
  static double degToRad(double deg);
  static double radToDeg(double rad);
  static double sin(double deg);
  static double cos(double deg);
  static double atan2(double y, double x);  ///< [deg]
  static double distanceBetween(double x1, double y1, double x2, double y2);
  /// Whether an angle lies in the counter-clockwise interval from one angle to another, ends included. An interval of
  /// 360° or more contains all angles.
  static bool angleBetween(double deg, double from_deg, double to_deg);
  static int roundInt(double value);  ///< halves away from 0
  /// Rotates a point about the origin.
  static std::pair<double, double> pointRotate(double x, double y, double deg);
};

/// A pose in ARIA's units: x, y [mm], th [deg], within (-180, 180].
struct PioneerPose {
  double x = 0, y = 0, th = 0;
  double getX() const { return x; }
  double getY() const { return y; }
  double getTh() const { return th; }
  double getThRad() const { return Math::degToRad(th); }
  void setX(double mm) { x = mm; }
  void setY(double mm) { y = mm; }
  void setTh(double deg) { th = Math::fixAngle(deg); }
  void setThRad(double rad) { setTh(Math::radToDeg(rad)); }
  void setPose(double x_mm, double y_mm, double th_deg = 0) { *this = {x_mm, y_mm, Math::fixAngle(th_deg)}; }
  double findDistanceTo(const PioneerPose& other) const;         ///< [mm]
  double squaredFindDistanceTo(const PioneerPose& other) const;  ///< [mm²]
  double findAngleTo(const PioneerPose& other) const;            ///< direction towards `other` [deg]
  bool operator==(const PioneerPose&) const = default;
};

/// Component by component, as in ARIA; no composition of frames (PioneerTransform).
PioneerPose operator+(const PioneerPose& a, const PioneerPose& b);
PioneerPose operator-(const PioneerPose& a, const PioneerPose& b);

/// Transformation between two frames of the plane, as ARIA's ArTransform.
class PioneerTransform {
 public:
  /// The identity.
  PioneerTransform() = default;
  /// From the frame whose pose is given to the frame in which it is given.
  explicit PioneerTransform(const PioneerPose& pose) { setTransform(pose); }
  /// From a frame in which a place has the pose `from` to one in which it has the pose `to`.
  PioneerTransform(const PioneerPose& from, const PioneerPose& to) { setTransform(from, to); }

  void setTransform(const PioneerPose& pose);
  void setTransform(const PioneerPose& from, const PioneerPose& to);
  PioneerPose doTransform(const PioneerPose& source) const;
  PioneerPose doInvTransform(const PioneerPose& source) const;
  double getTh() const { return origin_.th; }  ///< rotation [deg]

 private:
  PioneerPose origin_;  ///< of the source frame in the target frame
};

}  // namespace robosim
