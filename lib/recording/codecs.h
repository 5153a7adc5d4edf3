#pragma once
#include "recording/codec.h"

namespace robosim {

/// @name All codecs
/// Each is defined in its own file.
///@{
const Codec& scanCodec();
const Codec& rangeCodec();
const Codec& heatCodec();
const Codec& compassCodec();
const Codec& batteryCodec();
const Codec& bumperCodec();
const Codec& odometryCodec();
const Codec& imageCodec();
const Codec& blobCodec();
const Codec& beaconCodec();
const Codec& valuesCodec();
///@}

/// All codecs, with the class of their observations. The first one that encodes a sensor's measurements is used.
inline constexpr const Codec& (*kCodecs[])() = {
    scanCodec,      // CObservation2DRangeScan: lasers with evenly spaced beams
    rangeCodec,     // CObservationRange: all other sensors that measure echoes
    heatCodec,      // CObservationGasSensors
    compassCodec,   // CObservationIMU
    batteryCodec,   // CObservationBatteryState
    bumperCodec,    // CObservationRawDAQ
    odometryCodec,  // CObservationOdometry
    imageCodec,     // CObservationImage
    blobCodec,      // CObservationRawDAQ
    beaconCodec,    // CObservationBeaconRanges
    valuesCodec,    // CObservationRawDAQ
};

/// The codec of a sensor's measurements.
const Codec& codecOf(const SensorInfo&);

}  // namespace robosim
