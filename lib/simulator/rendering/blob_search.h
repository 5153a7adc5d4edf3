#pragma once
#include <string>
#include <vector>

#include "hardware/measurement.h"
#include "sensors/blob_finder.h"

namespace robosim {

/// The largest blob of each colour in a picture. Finds none in bytes that are not a JPEG file.
/// @throws nothing
std::vector<Blob> findBlobs(const std::string& jpeg, const std::vector<TargetColor>& colors, unsigned pixels_min);

}  // namespace robosim
