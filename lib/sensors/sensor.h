#pragma once
#include <cstdint>
#include <span>

#include <mrpt/math/TPoint2D.h>
#include <mrpt/math/TPoint3D.h>
#include <mrpt/math/TPose2D.h>

#include "base/random.h"
#include "base/sim_time.h"
#include "geometry/level_frame.h"
#include "geometry/scene.h"
#include "hardware/readings.h"
#include "hardware/sensor_info.h"
#include "sensors/image_source.h"

namespace robosim {

/// Something warm.
struct HeatSource {
  mrpt::math::TPoint2D center;  ///< world frame [m]
  double heat_celsius = 0;
  BodyId body = kNoBody;
};

/// What a robot did in the last time step.
struct Motion {
  double length_m = 0;  ///< driven, signed
  double turn_rad = 0;
};

/// The moment that sensors sense: everything stands still. Arrays are indexed by robot, in the world's order.
struct Snapshot {
  const Scene& scene;
  std::span<const HeatSource> heat_sources;
  std::span<const mrpt::math::TPose2D> world_from_robot;
  std::span<const LevelFrame> frames;   ///< the same poses, at the height of the robots' undersides
  std::span<const NeighbourList> near;  ///< what stands around each robot
  std::span<const Motion> last_motion;
  std::span<const float> laser_pan_rad;
  SimTime time;
  std::uint64_t seed = 0;
  ImageSource* images = nullptr;  ///< null: cameras take no pictures

  BodyId bodyOf(std::uint32_t robot) const { return scene.movingBody(robot); }
  /// The noise of one sensor of one robot in this step.
  Rng noise(std::uint32_t robot, std::size_t slot) const {
    return Rng(seed, RandomPurpose::sensor_noise, robot, static_cast<std::uint32_t>(slot), time.step);
  }
};

/// One kind of sensor with one set of options, as mounted on all robots of a model. It senses for many robots at once
/// and writes to each robot's own slot only, so robots may be split among threads in any way.
class Sensor {
 public:
  virtual ~Sensor() = default;

  virtual const SensorInfo& info() const = 0;
  /// A measurement of the right kind and size, as before the first step.
  virtual Measurement blank() const = 0;
  /// Whether it can sense only in the process that keeps the readings: because a measurement depends on the step
  /// before's, on another sensor's, or on an ImageSource. Any other may sense in a replica.
  virtual bool staysHome() const { return false; }
  /// Replaces readings[r].measurements[slot] for each r of `robots`; what stood there is the step before's. A sensor
  /// that stays home may look at slots before its own, of which those that stay home too have sensed already.
  virtual void sense(const Snapshot&, std::span<const std::uint32_t> robots, std::size_t slot,
                     std::span<Readings> readings) const = 0;
};

}  // namespace robosim
