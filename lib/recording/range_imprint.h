#pragma once
#include <cstdint>
#include <vector>

#include <mrpt/math/TPose3D.h>
#include <mrpt/obs/CObservationRange.h>

#include "recording/byte_archive.h"

namespace robosim {

/// Serialises a CObservationRange again and again while only its ranges and its timestamp change: MRPT writes it once,
/// and from then on just those bytes are replaced. MRPT turns every beam's pose into a quaternion each time it writes
/// one, which for a ring of 16 sonars takes longer than all the rest of a robot's observations together.
class RangeImprint {
 public:
  explicit RangeImprint(const mrpt::obs::CObservationRange& range);

  /// Appends what `archive << range` would. As quick as promised while the beams' poses are the constructor's.
  /// @param range the one given to the constructor, but for its timestamp, ranges and poses.
  void append(const mrpt::obs::CObservationRange& range, ByteArchive& archive);

 private:
  std::vector<mrpt::math::TPose3D> poses_;
  std::vector<std::uint8_t> bytes_;
  std::vector<std::size_t> range_at_;  ///< where in bytes_ the range of each beam begins
  std::size_t timestamp_at_ = 0;
};

}  // namespace robosim
