#pragma once
#include <memory>
#include <string>
#include <vector>

#include "base/xml_reader.h"
#include "sensors/registry.h"
#include "sensors/sensor.h"

namespace robosim {

/// A colour to detect, as ranges of hue, saturation and value. Illumination changes mostly the value, so a lit object
/// keeps its hue.
struct TargetColor {
  std::string name;
  double hue_rad = 0;            ///< [0, 2π): red 0, green 2π/3, blue 4π/3
  double within_rad = M_PI / 9;  ///< maximum deviation of the hue, (0, π]
  double saturation_min = 0.35;  ///< [0, 1]
  double value_min = 0.15;       ///< [0, 1]
};

/// Detects colour blobs in the picture of a camera on the same robot, as ACTS does for a Pioneer. Reports the largest
/// connected blob of each colour.
struct BlobFinderOptions {
  std::string label = "blob_finder";
  std::string camera;               ///< label of a camera mounted before it; empty: the last one before it
  unsigned pixels_min = 4;          ///< smaller blobs are ignored as noise, [1, 1e6]
  std::vector<TargetColor> colors;  ///< one to 32

  /// Reads <blob_finder>.
  static BlobFinderOptions read(XmlReader&);
};

/// @param mounted the sensors mounted before it, which must include its camera
/// @return null when the camera is missing, or has no colours; reports no error
std::unique_ptr<Sensor> makeBlobFinder(const BlobFinderOptions&,
                                       std::span<const std::shared_ptr<const Sensor>> mounted);

}  // namespace robosim
