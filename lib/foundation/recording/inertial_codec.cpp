#include <cmath>

#include <mrpt/obs/CObservationIMU.h>

#include "hardware/inertial_reading.h"
#include "recording/codecs.h"

namespace robosim {
namespace {

using namespace mrpt::obs;

constexpr TIMUDataIndex kFields[] = {IMU_YAW_VEL, IMU_X_ACC, IMU_Y_ACC, IMU_Z_ACC};

/// IMU: CObservationIMU with a yaw rate and three accelerations.
class InertialCodec : public CodecOf<CObservationIMU, Values> {
 public:
  bool encodes(const SensorInfo& sensor) const override {
    return sensor.kind == SensorKind::values && InertialReading::isOf(sensor);
  }

 private:
  void init(CObservationIMU& imu, const SensorInfo& sensor) const override {
    imu.sensorPose = mrpt::poses::CPose3D(mountOf(sensor));
    imu.dataIsPresent.fill(false);
    imu.rawMeasurements.fill(0);
  }
  void set(CObservationIMU& imu, const SensorInfo&, const Values& measured, float) const override {
    for (std::size_t i = 0; i < std::size(kFields); ++i) imu.set(kFields[i], measured.values[i]);
  }
  Values get(const CObservationIMU& imu, const SensorInfo& sensor, float) const override {
    Values measured;
    for (const TIMUDataIndex field : kFields) {
      if (!imu.has(field)) refuse(imu, sensor, "it lacks the yaw rate or an acceleration");
      measured.values.push_back(imu.get(field));
      if (!std::isfinite(measured.values.back())) refuse(imu, sensor, "a value is not finite");
    }
    return measured;
  }
  std::vector<Number> numbers(CObservationIMU& imu) const override {
    std::vector<Number> changing;
    for (const TIMUDataIndex field : kFields) changing.push_back(bytesOf(imu.rawMeasurements[field]));
    return changing;
  }
};

}  // namespace

const Codec& inertialCodec() { return theCodec<InertialCodec>(); }

}  // namespace robosim
