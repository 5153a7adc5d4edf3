#pragma once
#include <memory>
#include <string>

#include "base/angle_units.h"
#include "base/xml_reader.h"
#include "sensors/image_source.h"
#include "sensors/sensor.h"

namespace robosim {

/// A colour camera. The Snapshot's ImageSource renders its pictures; without an ImageSource it takes none.
struct CameraOptions {
  std::string label = "camera";
  CameraView view{.info = {.width_px = 320, .height_px = 240, .field_of_view_rad = 60 * kRadPerDeg, .rate_hz = 10},
                  .robot_from_camera = {},
                  .jpeg_quality = 85};

  /// Reads <camera>.
  static CameraOptions read(XmlReader&);
};

std::unique_ptr<Sensor> makeCamera(const CameraOptions&);

/// Whether a camera of this rate takes a picture in a step (MeasurementTimes::isDue()).
bool takesPicture(double rate_hz, const SimTime& now);

}  // namespace robosim
