#pragma once
#include <mrpt/obs/CObservationRawDAQ.h>

#include "recording/codec.h"

namespace robosim {

/// Codec of any kind of measurement without an MRPT class of its own: CObservationRawDAQ, whose double-precision
/// analogue inputs are the numbers of the measurement, as its Description orders them.
template <typename M>
class AnalogueCodec : public CodecOf<mrpt::obs::CObservationRawDAQ, M> {
  using RawDaq = mrpt::obs::CObservationRawDAQ;

  void set(RawDaq& daq, const SensorInfo&, const M& measurement, float) const override {
    daq.AIN_double.clear();
    forNumbers(measurement,
               [&](const auto&, auto number, std::size_t) { daq.AIN_double.push_back(static_cast<double>(number)); });
  }

  M get(const RawDaq& daq, const SensorInfo& sensor, float) const override {
    M measurement = Description<M>::blank(sensor);
    const std::size_t records = Description<M>::records(measurement).size();
    checkSize(daq, sensor, daq.AIN_double.size(), records * kFieldCount<M>);
    const std::string fault = setNumbers(measurement, std::span<const double>(daq.AIN_double));
    if (!fault.empty()) refuse(daq, sensor, "it has " + fault);
    return measurement;
  }
};

}  // namespace robosim
