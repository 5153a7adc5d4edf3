#pragma once
#include <memory>
#include <string>
#include <vector>

#include "base/xml_reader.h"
#include "sensors/registry.h"
#include "sensors/sensor.h"

namespace robosim {

/// What counts as one colour, as hue, saturation and value: light and shade change mostly the last, so that a lit thing
/// keeps its hue.
struct SoughtColor {
  std::string name;
  double hue_rad = 0;            ///< [0, 2π): red 0, green 2π/3, blue 4π/3
  double within_rad = M_PI / 9;  ///< how far the hue may be off, (0, π]
  double saturation_min = 0.35;  ///< [0, 1]
  double value_min = 0.15;       ///< [0, 1]
};

/// Looks for spots of colour in the picture of a camera on the same robot, as ACTS does for a Pioneer: of each colour
/// it tells the largest connected one.
struct BlobFinderOptions {
  std::string label = "blob_finder";
  std::string camera;               ///< the label of one that is mounted before it; empty for the last one before it
  unsigned pixels_min = 4;          ///< smaller spots are noise, [1, 1e6]
  std::vector<SoughtColor> colors;  ///< one to 32

  /// Reads <blob_finder>.
  static BlobFinderOptions read(XmlReader&);
};

/// @param mounted what is mounted before it: its camera must be among them
/// @return null, and no more, when the camera is not there
std::unique_ptr<Sensor> makeBlobFinder(const BlobFinderOptions&,
                                       std::span<const std::shared_ptr<const Sensor>> mounted);

/// The largest spot of each colour in a picture. @throws nothing: in what is no JPEG file nothing is found.
std::vector<Blob> findBlobs(const std::string& jpeg, const std::vector<SoughtColor>& colors, unsigned pixels_min);

}  // namespace robosim
