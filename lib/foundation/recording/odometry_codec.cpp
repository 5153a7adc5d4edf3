#include <mrpt/obs/CObservationOdometry.h>

#include "recording/codecs.h"

namespace robosim {
namespace {

using mrpt::obs::CObservationOdometry;

/// Odometry: CObservationOdometry with speeds.
class OdometryCodec : public CodecOf<CObservationOdometry, Odometry> {
  void init(CObservationOdometry& observation, const SensorInfo&) const override { observation.hasVelocities = true; }

  void set(CObservationOdometry& observation, const SensorInfo&, const Odometry& odometry, float) const override {
    observation.odometry.x(odometry.odom_from_robot.x);
    observation.odometry.y(odometry.odom_from_robot.y);
    // The constructor would wrap the angle, with a loss of precision.
    observation.odometry.phi(odometry.odom_from_robot.phi);
    const double turn_radps = odometry.turn_radps == 0 ? kNoTurn_radps : odometry.turn_radps;
    observation.velocityLocal = {odometry.speed_mps, odometry.lateral_mps, turn_radps};
  }

  Odometry get(const CObservationOdometry& observation, const SensorInfo&, float) const override {
    Odometry odometry = recordedIn(observation);
    if (odometry.turn_radps == kNoTurn_radps) odometry.turn_radps = 0;
    return odometry;
  }

  std::vector<Number> numbers(CObservationOdometry& observation) const override {
    auto& pose = observation.odometry;
    const auto& velocity = observation.velocityLocal;
    return {bytesOf(pose.x()),    bytesOf(pose.y()),       bytesOf(pose.phi()),
            bytesOf(velocity.vx), bytesOf(velocity.omega), bytesOf(velocity.vy)};
  }

  bool append(const CObservationOdometry& observation, ObservedNumbers& all) const override {
    const Odometry odometry = recordedIn(observation);
    forNumbers(odometry, [&](const auto& field, double number, std::size_t) {
      all.push_back({field.name, {}, field.unit, number});
    });
    constexpr std::size_t kPoseNumbers = 3;
    if (!observation.hasVelocities) all.resize(kPoseNumbers);
    return true;
  }

  static Odometry recordedIn(const CObservationOdometry& observation) {
    Odometry odometry;
    odometry.odom_from_robot = {observation.odometry.x(), observation.odometry.y(), observation.odometry.phi()};
    if (observation.hasVelocities) {
      odometry.speed_mps = observation.velocityLocal.vx;
      odometry.turn_radps = observation.velocityLocal.omega;
      odometry.lateral_mps = observation.velocityLocal.vy;
    }
    return odometry;
  }
};

}  // namespace

const Codec& odometryCodec() { return theCodec<OdometryCodec>(); }

}  // namespace robosim
