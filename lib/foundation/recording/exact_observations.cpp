#include "recording/exact_observations.h"

#include "recording/picture_compression.h"

namespace robosim {

void ExactImageObservation::serializeTo(mrpt::serialization::CArchive& out) const {
  const PictureCompression off(false);
  CObservationImage::serializeTo(out);
}

void ExactDepthObservation::serializeTo(mrpt::serialization::CArchive& out) const {
  const PictureCompression off(false);
  CObservation3DRangeScan::serializeTo(out);
}

}  // namespace robosim
