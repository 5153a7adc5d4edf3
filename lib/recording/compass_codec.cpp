#include <mrpt/obs/CObservationIMU.h>

#include "recording/codecs.h"

namespace robosim {
namespace {

using mrpt::obs::CObservationIMU;

/// Compass: CObservationIMU with only a yaw.
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
    if (!imu.has(mrpt::obs::IMU_YAW)) return false;
    all.push_back({"yaw", {}, kRadian, imu.get(mrpt::obs::IMU_YAW)});
    return true;
  }
};

}  // namespace

const Codec& compassCodec() { return theCodec<CompassCodec>(); }

}  // namespace robosim
