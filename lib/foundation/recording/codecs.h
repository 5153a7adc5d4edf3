#pragma once
#include <vector>

#include <mrpt/obs/CObservation.h>

#include "recording/codec.h"

namespace robosim {

/// @name RoboSim's own codecs
/// Each is defined in its own file.
///@{
const Codec& scanCodec();
const Codec& lidarCodec();
const Codec& rangeCodec();
const Codec& heatCodec();
const Codec& compassCodec();
const Codec& batteryCodec();
const Codec& bumperCodec();
const Codec& odometryCodec();
const Codec& imageCodec();
const Codec& raycastImageCodec();
const Codec& raycastDepthCodec();
const Codec& blobCodec();
const Codec& beaconCodec();
const Codec& bearingRangeCodec();
const Codec& gnssCodec();
const Codec& inertialCodec();
const Codec& valuesCodec();
///@}

/// Sets the pose and the parameters of a picture's camera in a CObservationImage or CObservation3DRangeScan: what their
/// codecs do for one without a head.
void setCamera(mrpt::obs::CObservation& picture, const SensorInfo& camera);

/// Recorded value of an odometry's angular speed of exactly 0: stock icp-slam computes NaN for 0.
inline constexpr double kNoTurn_radps = 1e-6;

/// All codecs, addedCodecs() first. The first one that encodes a sensor's measurements is used.
std::vector<const Codec*> codecs();

/// The codec of a sensor's measurements.
const Codec& findCodec(const SensorInfo&);

}  // namespace robosim
