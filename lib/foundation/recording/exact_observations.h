#pragma once
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationImage.h>

namespace robosim {

/// @name Observations of ray-cast cameras
/// They are stock observations whose pixels are serialised as they are; MRPT itself would compress them with losses
/// when other pictures are to be compressed, because its switch is global.
///@{
class ExactImageObservation : public mrpt::obs::CObservationImage {
 public:
  using CObservationImage::CObservationImage;
  explicit ExactImageObservation(const CObservationImage& observation) : CObservationImage(observation) {}

 protected:
  void serializeTo(mrpt::serialization::CArchive& out) const override;
};

class ExactDepthObservation : public mrpt::obs::CObservation3DRangeScan {
 public:
  using CObservation3DRangeScan::CObservation3DRangeScan;
  explicit ExactDepthObservation(const CObservation3DRangeScan& observation) : CObservation3DRangeScan(observation) {}

 protected:
  void serializeTo(mrpt::serialization::CArchive& out) const override;
};

/// The name of the camera in their parameters, by which they are recognised when they have been read.
inline constexpr const char* kExactCameraName = "raycast";
///@}

}  // namespace robosim
