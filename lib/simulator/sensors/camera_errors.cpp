#include "sensors/camera_errors.h"

namespace robosim {
namespace {

/// Whether every pixel of a picture shows something: the lens can be inverted at the corners.
bool coversPicture(const CameraInfo& info) {
  const double right = info.width_px / 2.0 / info.focalLength(), down = info.height_px / 2.0 / info.focalLength();
  LensDistortion::Point ideal;
  for (const double x : {-right, right}) {
    for (const double y : {-down, down}) {
      if (!info.distortion.undistort({x, y}, ideal)) return false;
    }
  }
  return true;
}

}  // namespace

CameraErrors CameraErrors::read(XmlReader& camera, CameraInfo& info) {
  CameraErrors e;
  auto noise = camera.child("noise");
  if (!noise) return e;
  e.noise_std = noise->number("std", {0, 255}, e.noise_std);
  e.exposure = noise->number("exposure", {0, 100}, e.exposure);
  e.exposure_std = noise->number("exposure_std", {0, 1}, e.exposure_std);
  e.rolling_shutter_s = noise->number("rolling_shutter_s", {0, 1}, e.rolling_shutter_s);
  LensDistortion& lens = info.distortion;
  lens.k1 = noise->number("k1", {-10, 10}, 0);
  lens.k2 = noise->number("k2", {-10, 10}, 0);
  lens.p1 = noise->number("p1", {-1, 1}, 0);
  lens.p2 = noise->number("p2", {-1, 1}, 0);
  lens.k3 = noise->number("k3", {-10, 10}, 0);
  if (!coversPicture(info)) {
    noise->error(
        "the distortion has no inverse at the corners of the picture; use smaller coefficients or field of view");
  }
  noise->finish();
  return e;
}

}  // namespace robosim
