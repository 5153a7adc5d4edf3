#pragma once
#include <vector>

#include "hardware/measurement.h"
#include "sensors/blob_finder.h"

namespace robosim {

/// The largest 8-connected region of each colour in an exact picture, by union-find over runs of pixels; of equally
/// large ones the one that begins first, row by row. Equal on every machine. Without colours, none are visible.
/// @param pixels_min smaller regions are ignored
std::vector<Blob> findBlobs(const RawPicture& picture, const std::vector<TargetColor>& colors, unsigned pixels_min);

}  // namespace robosim
