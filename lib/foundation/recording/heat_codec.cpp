#include <mrpt/obs/CObservationGasSensors.h>

#include "recording/codecs.h"

namespace robosim {
namespace {

using mrpt::obs::CObservationGasSensors;

/// Heat: CObservationGasSensors, one e-nose with only a temperature, in single precision.
class HeatCodec : public CodecOf<CObservationGasSensors, Scalar> {
 public:
  bool encodes(const SensorInfo& sensor) const override { return sensor.kind == SensorKind::heat; }

 private:
  void init(CObservationGasSensors& heat, const SensorInfo& sensor) const override {
    auto& nose = heat.m_readings.emplace_back();
    nose.eNosePoseOnTheRobot = mountOf(sensor);
    nose.hasTemperature = true;
    nose.isActive = true;
  }

  void set(CObservationGasSensors& heat, const SensorInfo&, const Scalar& scalar, float) const override {
    heat.m_readings[0].temperature = static_cast<float>(scalar.value);
  }

  Scalar get(const CObservationGasSensors& heat, const SensorInfo& sensor, float) const override {
    checkSize(heat, sensor, heat.m_readings.size(), 1);
    if (!heat.m_readings[0].hasTemperature) refuse(heat, sensor, "it has no temperature");
    return {heat.m_readings[0].temperature};
  }

  std::vector<Number> numbers(CObservationGasSensors& heat) const override {
    return {bytesOf(heat.m_readings[0].temperature)};
  }

  bool append(const CObservationGasSensors& heat, ObservedNumbers& all) const override {
    for (std::size_t i = 0; i < heat.m_readings.size(); ++i) {
      const auto& nose = heat.m_readings[i];
      if (nose.hasTemperature) all.push_back({"temperature", i, kCelsius, nose.temperature});
      for (std::size_t k = 0; k < nose.readingsVoltage.size(); ++k) {
        all.push_back({"nose_" + std::to_string(i), k, kVolt, nose.readingsVoltage[k]});
      }
    }
    return true;
  }
};

}  // namespace

const Codec& heatCodec() { return theCodec<HeatCodec>(); }

}  // namespace robosim
