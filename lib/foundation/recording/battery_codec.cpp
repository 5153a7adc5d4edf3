#include <mrpt/obs/CObservationBatteryState.h>

#include "recording/codecs.h"

namespace robosim {
namespace {

using mrpt::obs::CObservationBatteryState;

/// Battery: CObservationBatteryState with the main battery's voltage.
class BatteryCodec : public CodecOf<CObservationBatteryState, Scalar> {
 public:
  bool encodes(const SensorInfo& sensor) const override { return sensor.kind == SensorKind::battery; }

 private:
  void init(CObservationBatteryState& battery, const SensorInfo&) const override {
    battery.voltageMainRobotBatteryIsValid = true;
  }

  void set(CObservationBatteryState& battery, const SensorInfo&, const Scalar& scalar, float) const override {
    battery.voltageMainRobotBattery = scalar.value;
  }

  Scalar get(const CObservationBatteryState& battery, const SensorInfo& sensor, float) const override {
    if (!battery.voltageMainRobotBatteryIsValid) refuse(battery, sensor, "it has no voltage of the main battery");
    return {battery.voltageMainRobotBattery};
  }

  std::vector<Number> numbers(CObservationBatteryState& battery) const override {
    return {bytesOf(battery.voltageMainRobotBattery)};
  }

  bool append(const CObservationBatteryState& battery, ObservedNumbers& all) const override {
    all.push_back({"voltage", {}, kVolt, battery.voltageMainRobotBattery});
    return true;
  }
};

}  // namespace

const Codec& batteryCodec() { return theCodec<BatteryCodec>(); }

}  // namespace robosim
