#pragma once
#include <memory>
#include <optional>
#include <string>

#include "base/angle_units.h"
#include "base/xml_reader.h"
#include "sensors/camera_head.h"
#include "sensors/image_source.h"
#include "sensors/sensor.h"

namespace robosim {

/// A camera. Pictures of the model `opengl` are rendered by the Snapshot's ImageSource; without one it takes none.
/// Those of the model `raycast` (view.info.isRaycast()) are cast in sense(), exact and without OpenGL. One with a head
/// turns and zooms as the head measures, whose sensor is mounted directly before it.
struct CameraOptions {
  std::string label = "camera";
  double range_max_m = 20;  ///< of the model `raycast`: largest depth that it sees, (0, 1000]
  CameraView view{.info = {.width_px = 320, .height_px = 240, .field_of_view_rad = 60 * kRadPerDeg, .rate_hz = 10},
                  .robot_from_camera = {},
                  .jpeg_quality = 85};
  std::optional<CameraHeadOptions> head = std::nullopt;

  /// Reads <camera>.
  static CameraOptions read(XmlReader&);
};

/// @param head_slot of the sensor of its head
std::unique_ptr<Sensor> makeCamera(const CameraOptions&, std::size_t head_slot = 0);
/// A camera of the model `raycast` (raycast_sensor.cpp).
std::unique_ptr<Sensor> makeRaycastCamera(const CameraOptions&, std::size_t head_slot);
/// The head to mount before a camera; nullptr for a camera without one, and for other sensors.
std::unique_ptr<Sensor> makeHeadOf(const Sensor&);

/// Whether a camera of this rate takes a picture in a step (MeasurementTimes::isDue()).
bool takesPicture(double rate_hz, const SimTime& now);

}  // namespace robosim
