#pragma once
#include <cstdint>
#include <vector>

#include "base/xml_reader.h"
#include "hardware/sensor_info.h"

namespace robosim {

/// Errors of a camera's pictures, in 8-bit levels. The lens is in CameraInfo::distortion. Omitted: blur by motion and
/// focus, vignetting, colour filters, and the lines of a rolling shutter while the robot drives straight ahead.
struct CameraErrors {
  double noise_std = 0;          ///< standard deviation of each pixel and colour [levels], [0, 255]
  double exposure = 1;           ///< factor of the brightness, before it saturates, [0, 100]
  double exposure_std = 0;       ///< relative standard deviation of the exposure, between pictures, [0, 1]
  double rolling_shutter_s = 0;  ///< time from the first to the last row, which is read at the end of the step, [0, 1]
  bool operator==(const CameraErrors&) const = default;

  bool isNone() const { return *this == CameraErrors{}; }
  bool isRandom() const { return noise_std > 0 || exposure_std > 0; }
  /// Reads a child <noise> of <camera>, and the lens into `info`, whose other members are set.
  static CameraErrors read(XmlReader& camera, CameraInfo& info);
};

/// What the errors of pictures depend on, besides the camera.
struct CameraMoment {
  std::vector<std::uint64_t> seeds;  ///< by picture: of its random numbers
  std::vector<double> turn_radps;    ///< by picture: turn rate of its robot
};

}  // namespace robosim
