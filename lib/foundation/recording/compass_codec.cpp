#include <iterator>

#include <mrpt/obs/CObservationIMU.h>

#include "recording/codecs.h"

namespace robosim {
namespace {

using mrpt::obs::CObservationIMU;

/// A value of an IMU, in the order of mrpt::obs::TIMUDataIndex.
struct ImuField {
  const char* name;
  Unit unit;
};
constexpr Unit kAcceleration{"mps2", "m/s²"};
constexpr ImuField kImuFields[mrpt::obs::COUNT_IMU_DATA_FIELDS] = {
    {"acceleration_x", kAcceleration},
    {"acceleration_y", kAcceleration},
    {"acceleration_z", kAcceleration},
    {"yaw_rate", kRadianPerSecond},
    {"pitch_rate", kRadianPerSecond},
    {"roll_rate", kRadianPerSecond},
    {"speed_x", kMetrePerSecond},
    {"speed_y", kMetrePerSecond},
    {"speed_z", kMetrePerSecond},
    {"yaw", kRadian},
    {"pitch", kRadian},
    {"roll", kRadian},
    {"x", kMetre},
    {"y", kMetre},
    {"z", kMetre},
    {"magnetic_x", {"gauss", "gauss"}},
    {"magnetic_y", {"gauss", "gauss"}},
    {"magnetic_z", {"gauss", "gauss"}},
    {"pressure", {"pa", "Pa"}},
    {"altitude", kMetre},
    {"temperature", kCelsius},
    {"quaternion_x", kNoUnit},
    {"quaternion_y", kNoUnit},
    {"quaternion_z", kNoUnit},
    {"quaternion_w", kNoUnit},
    {"global_yaw_rate", kRadianPerSecond},
    {"global_pitch_rate", kRadianPerSecond},
    {"global_roll_rate", kRadianPerSecond},
    {"global_acceleration_x", kAcceleration},
    {"global_acceleration_y", kAcceleration},
    {"global_acceleration_z", kAcceleration},
};

/// Compass: CObservationIMU with only a yaw. Other programs' IMUs have more values, which are listed by name.
class CompassCodec : public CodecOf<CObservationIMU, Scalar> {
 public:
  bool encodes(const SensorInfo& sensor) const override { return sensor.kind == SensorKind::compass; }

 private:
  void init(CObservationIMU& compass, const SensorInfo& sensor) const override {
    compass.sensorPose = mrpt::poses::CPose3D(mountOf(sensor));
    compass.dataIsPresent.fill(false);
    compass.rawMeasurements.fill(0);
  }

  void set(CObservationIMU& compass, const SensorInfo&, const Scalar& scalar, float) const override {
    compass.set(mrpt::obs::IMU_YAW, scalar.value);
  }

  Scalar get(const CObservationIMU& compass, const SensorInfo& sensor, float) const override {
    if (!compass.has(mrpt::obs::IMU_YAW)) refuse(compass, sensor, "it has no yaw");
    return {compass.get(mrpt::obs::IMU_YAW)};
  }

  std::vector<Number> numbers(CObservationIMU& compass) const override {
    return {bytesOf(compass.rawMeasurements[mrpt::obs::IMU_YAW])};
  }

  bool append(const CObservationIMU& imu, ObservedNumbers& all) const override {
    const std::size_t before = all.size();
    for (std::size_t i = 0; i < std::size(kImuFields); ++i) {
      if (imu.dataIsPresent[i]) all.push_back({kImuFields[i].name, {}, kImuFields[i].unit, imu.rawMeasurements[i]});
    }
    return all.size() > before;
  }
};

}  // namespace

const Codec& compassCodec() { return theCodec<CompassCodec>(); }

}  // namespace robosim
