#pragma once
#include <memory>
#include <optional>
#include <string>

#include "base/xml_reader.h"
#include "hardware/camera_head.h"
#include "sensors/sensor.h"

namespace robosim {

/// The head of a camera that pans, tilts and zooms (PTZ): a sensor that measures its CameraAim. In each step it moves
/// towards Command::camera_head, each axis at its own limited speed and without acceleration, from straight ahead
/// without zoom at the start.
struct CameraHeadOptions {
  std::string label = "ptz";
  CameraHeadLimits limits;
  bool operator==(const CameraHeadOptions&) const = default;

  /// Reads a child <ptz> of <camera>; nullopt when there is none.
  static std::optional<CameraHeadOptions> read(XmlReader& camera);
};

/// A sensor that may be mounted on a head.
class MountedOnHead : public Sensor {
 public:
  virtual std::optional<CameraHeadOptions> cameraHead() const = 0;
};

std::unique_ptr<Sensor> makeCameraHead(const CameraHeadOptions&);

/// The aim after a step of `period_s` from an aim within the limits.
CameraAim movedTowards(const CameraHeadCommand&, const CameraAim& from, const CameraHeadLimits&, double period_s);

}  // namespace robosim
