#include "aria/ptz.h"

#include <algorithm>
#include <cmath>

#include "base/angle_units.h"

namespace robosim {

bool PTZ::init() {
  zoom(getMinZoom());
  return panTilt(0, 0);
}

bool PTZ::panTilt(double pan_deg, double tilt_deg) {
  const CameraHeadLimits within = limits();
  robot_.aimCamera(std::clamp(-sign_ * pan_deg * kRadPerDeg, within.pan_min_rad, within.pan_max_rad),
                   std::clamp(sign_ * tilt_deg * kRadPerDeg, within.tilt_min_rad, within.tilt_max_rad));
  return isThere();
}

bool PTZ::zoom(int position) {
  const double share = std::clamp(position, 0, kZoomMax) / static_cast<double>(kZoomMax);
  robot_.zoomCamera(1 + share * (limits().zoom_max - 1));
  return canZoom();
}

bool PTZ::haltPanTilt() {
  const CameraAim aim = robot_.cameraAim();
  robot_.aimCamera(aim.pan_rad, aim.tilt_rad);
  return isThere();
}

bool PTZ::haltZoom() {
  robot_.zoomCamera(robot_.cameraAim().zoom);
  return canZoom();
}

bool PTZ::panSlew(double degps) {
  robot_.limitCameraSpeed(degps * kRadPerDeg, robot_.command().camera_head->tilt_radps);
  return isThere();
}

bool PTZ::tiltSlew(double degps) {
  robot_.limitCameraSpeed(robot_.command().camera_head->pan_radps, degps * kRadPerDeg);
  return isThere();
}

double PTZ::getPan() const { return -sign_ * robot_.cameraAim().pan_rad / kRadPerDeg; }
double PTZ::getTilt() const { return sign_ * robot_.cameraAim().tilt_rad / kRadPerDeg; }
double PTZ::panCommanded() const { return -sign_ * robot_.command().camera_head->aim.pan_rad / kRadPerDeg; }
double PTZ::tiltCommanded() const { return sign_ * robot_.command().camera_head->aim.tilt_rad / kRadPerDeg; }

double PTZ::getMaxPosPan() const { return (getInverted() ? limits().pan_max_rad : -limits().pan_min_rad) / kRadPerDeg; }
double PTZ::getMaxNegPan() const { return (getInverted() ? limits().pan_min_rad : -limits().pan_max_rad) / kRadPerDeg; }
double PTZ::getMaxPosTilt() const {
  return (getInverted() ? -limits().tilt_min_rad : limits().tilt_max_rad) / kRadPerDeg;
}
double PTZ::getMaxNegTilt() const {
  return (getInverted() ? -limits().tilt_max_rad : limits().tilt_min_rad) / kRadPerDeg;
}
double PTZ::getMaxPanSpeed() const { return limits().pan_radps / kRadPerDeg; }
double PTZ::getMaxTiltSpeed() const { return limits().tilt_radps / kRadPerDeg; }

double PTZ::getPanSlew() const {
  const double degps = robot_.command().camera_head->pan_radps / kRadPerDeg;
  return degps > 0 ? std::min(degps, getMaxPanSpeed()) : getMaxPanSpeed();
}
double PTZ::getTiltSlew() const {
  const double degps = robot_.command().camera_head->tilt_radps / kRadPerDeg;
  return degps > 0 ? std::min(degps, getMaxTiltSpeed()) : getMaxTiltSpeed();
}

double PTZ::getFOVAtMinZoom() const {
  const auto& sensors = *robot_.info().sensors;
  const auto camera = std::find_if(sensors.begin(), sensors.end(), [](const SensorInfo& sensor) {
    return sensor.kind == SensorKind::camera && sensor.pans;
  });
  return camera == sensors.end() ? 0 : camera->camera.field_of_view_rad / kRadPerDeg;
}
double PTZ::getFOVAtMaxZoom() const { return getFOVAtMinZoom() / limits().zoom_max; }

int PTZ::positionOf(double zoom) const {
  const double range = limits().zoom_max - 1;
  if (range <= 0) return 0;
  return static_cast<int>(std::lround(std::clamp((zoom - 1) / range, 0.0, 1.0) * kZoomMax));
}

}  // namespace robosim
