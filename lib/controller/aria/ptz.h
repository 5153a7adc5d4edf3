#pragma once
#include "control/robot.h"

namespace robosim {

/// A camera that pans, tilts and zooms, with the names and units of ARIA's ArPTZ and ArVCC4: degrees, pan to the right,
/// tilt up, zoom from getMinZoom() to getMaxZoom(), in which the magnification is linear. In ARIA it is made of the
/// ArRobot, here of the Robot that a PioneerRobot is made of. Limits are those of the robot's camera. Positions are
/// those of this step, not those that were commanded last.
class PTZ {
 public:
  /// @param robot must outlive this @param inverted upside down: pan and tilt count the other way round
  explicit PTZ(Robot& robot, bool inverted = false) : robot_(robot), sign_(inverted ? -1 : 1) {}

  /// @name Commands
  /// Beyond a limit, to the limit. Relative ones are relative to what was commanded last.
  /// @return whether the robot has such a camera
  ///@{
  bool init();  ///< to 0, 0 and the least zoom, as reset()
  void reset() { init(); }
  bool panTilt(double pan_deg, double tilt_deg);
  bool pan(double deg) { return panTilt(deg, tiltCommanded()); }
  bool tilt(double deg) { return panTilt(panCommanded(), deg); }
  bool panTiltRel(double pan_deg, double tilt_deg) {
    return panTilt(panCommanded() + pan_deg, tiltCommanded() + tilt_deg);
  }
  bool panRel(double deg) { return panTiltRel(deg, 0); }
  bool tiltRel(double deg) { return panTiltRel(0, deg); }
  bool zoom(int position);
  bool zoomRel(int positions) { return zoom(positionOf(robot_.command().camera_head->aim.zoom) + positions); }
  bool haltPanTilt();
  bool haltZoom();
  bool panSlew(double degps);   ///< speed of the pan; 0: the largest
  bool tiltSlew(double degps);  ///< of the tilt
  bool setPanSpeed(double degps) { return panSlew(degps); }
  bool setTiltSpeed(double degps) { return tiltSlew(degps); }
  ///@}

  /// @name State in this step
  ///@{
  double getPan() const;
  double getTilt() const;
  int getZoom() const { return positionOf(robot_.cameraAim().zoom); }
  ///@}

  /// @name Limits
  /// All 0 for a robot without such a camera.
  ///@{
  double getMaxPosPan() const;
  double getMaxNegPan() const;
  double getMaxPosTilt() const;
  double getMaxNegTilt() const;
  double getMaxPan() const { return getMaxPosPan(); }
  double getMinPan() const { return getMaxNegPan(); }
  double getMaxTilt() const { return getMaxPosTilt(); }
  double getMinTilt() const { return getMaxNegTilt(); }
  int getMaxZoom() const { return isThere() ? kZoomMax : 0; }
  int getMinZoom() const { return 0; }
  double getMaxPanSpeed() const;   ///< [deg/s]
  double getMaxTiltSpeed() const;  ///< [deg/s]
  double getMaxPanSlew() const { return getMaxPanSpeed(); }
  double getMaxTiltSlew() const { return getMaxTiltSpeed(); }
  double getPanSlew() const;  ///< as commanded [deg/s]
  double getTiltSlew() const;
  double getFOVAtMinZoom() const;  ///< horizontal field of view [deg]
  double getFOVAtMaxZoom() const;
  ///@}

  /// @name What it can do
  ///@{
  bool canZoom() const { return isThere() && robot_.cameraHead()->zoom_max > 1; }
  bool canGetRealPanTilt() const { return isThere(); }
  bool canGetRealZoom() const { return canZoom(); }
  bool canPanTiltSlew() const { return isThere(); }
  bool canSetSpeed() const { return isThere(); }
  bool canGetFOV() const { return isThere(); }
  ///@}

  void setInverted(bool inverted) { sign_ = inverted ? -1 : 1; }
  bool getInverted() const { return sign_ < 0; }

 private:
  static constexpr int kZoomMax = 1960;  ///< of a Canon VC-C4

  bool isThere() const { return robot_.cameraHead() != nullptr; }
  /// Limits of the camera; all 0 without one.
  CameraHeadLimits limits() const { return isThere() ? *robot_.cameraHead() : CameraHeadLimits{}; }
  double panCommanded() const;
  double tiltCommanded() const;
  int positionOf(double zoom) const;

  Robot& robot_;
  int sign_ = 1;
};

}  // namespace robosim
