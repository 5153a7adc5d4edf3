#pragma once
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>

#include <mrpt/math/TPoint2D.h>
#include <mrpt/math/TPoint3D.h>
#include <mrpt/math/TPose2D.h>

#include "base/portable_math.h"
#include "base/random.h"
#include "base/sim_time.h"
#include "geometry/scene.h"
#include "geometry/shapes/path.h"
#include "hardware/command.h"
#include "hardware/readings.h"
#include "hardware/sensor_info.h"
#include "sensors/floor_picture.h"
#include "sensors/image_source.h"
#include "sensors/raycast/picture.h"
#include "world/changed_objects.h"
#include "world/georeference.h"
#include "world/world.h"

namespace robosim {

/// A heat source in the world.
struct HeatSource {
  mrpt::math::TPoint2D center;  ///< world frame [m]
  double heat_celsius = 0;
  BodyId body = kNoBody;
};

/// A body that some sensors perceive otherwise than by its shape: the floor's areas, lights and fiducial marks.
struct FeaturedBody {
  Body body;  ///< at its present place
  Solid solid;
  BodyId id = kNoBody;
  bool is_present = true;

  /// Whether sensors need it.
  static bool isOne(const Body& body) { return body.isFloor() || body.light_cd != 0 || body.fiducial != 0; }
};

/// Motion of a robot in the last time step.
struct Motion {
  double length_m = 0;  ///< driven ahead, signed
  double turn_rad = 0;
  double lateral_m = 0;  ///< to the left; of omnidirectional and tracked drives
  bool operator==(const Motion&) const = default;
};

/// Length of its way over the ground, without sign [m].
inline double groundLength(const Motion& motion) {
  return motion.lateral_m == 0 ? std::abs(motion.length_m) : portable::hypot(motion.length_m, motion.lateral_m);
}

/// A robot's gripper that is closed.
struct ClosedGripper {
  std::uint32_t robot = 0;  ///< index in the world
  std::string object;       ///< that it holds; empty for none
  mrpt::math::TPose2D robot_from_object = {};
  bool operator==(const ClosedGripper&) const = default;
};

/// State of the world in which sensors measure, constant during a measurement. Arrays are indexed by robot, in the
/// world's order.
struct Snapshot {
  const Scene& scene;
  std::span<const HeatSource> heat_sources;
  std::span<const mrpt::math::TPose2D> world_from_robot;
  std::span<const PlanarTransform> frames;  ///< the same poses, at the height of the robots' undersides
  std::span<const Motion> last_motion;
  std::span<const Motion> former_motion = {};  ///< of the step before the last; empty unless a sensor uses it
  std::span<const float> laser_pan_rad;
  std::span<const Activity> activity = {};  ///< empty: no robot is absent
  SimTime time;
  std::uint64_t seed = 0;
  ImageSource* images = nullptr;  ///< null: cameras take no pictures
  ChangedObjects objects = {};    ///< of pictures; the scene has them already
  /// Area that robots stay in; nullopt: unbounded.
  std::optional<Bounds2D> surface = std::nullopt;
  std::span<const Path> paths = {};                     ///< of this step, clipped; empty: no motion has been blocked
  std::span<const double> driven_m = {};                ///< distance driven since the start; empty: none
  std::span<const float> reflectivity = {};             ///< by body; kReflectivity for bodies beyond its end
  std::span<const ClosedGripper> closed_grippers = {};  ///< in ascending order of robots
  std::span<const FeaturedBody> featured = {};          ///< objects in the world's order, then robots
  std::span<const FloorPicture> floor_pictures = {};    ///< the last one is on top
  std::span<const Command> commands = {};               ///< of this step, with the colours of LEDs

  const GeoReference* georeference = nullptr;  ///< of the world; null: none

  /// @name What ray-cast cameras see; empty without one
  ///@{
  std::span<const SurfaceLook> looks = {};         ///< by body
  std::span<const std::uint32_t> identities = {};  ///< by body, as in RawPicture::identity
  const FloorLook* floor = nullptr;
  ///@}

  /// Motion along the commanded path that a robot could not make in this step; a turn only where it stops with the
  /// path.
  Motion blocked(std::uint32_t robot) const {
    if (time.step == 0 || paths.empty()) return {};  // paths of step 0 are those of the run before
    const Path& path = paths[robot];
    const double length_m = path.length_m - path.clippedLength();
    const double turn_rad = path.turn_rad - path.clippedTurn();
    if (path.direction_rad == 0) return {length_m, turn_rad, 0};
    const auto [sin, cos] = portable::sincos(path.direction_rad);
    return {length_m * cos, turn_rad, length_m * sin};
  }

  /// Share of light that a body's surface returns, [0, 1].
  double reflectivityOf(BodyId body) const {
    const auto i = static_cast<std::size_t>(body);
    return i < reflectivity.size() ? static_cast<double>(reflectivity[i]) : kReflectivity;
  }
  BodyId bodyOf(std::uint32_t robot) const { return scene.movingBody(robot); }
  /// Random stream of one sensor of one robot in this step. @param stream further streams of the same sensor, [0, 16)
  Rng noise(std::uint32_t robot, std::size_t slot, std::uint32_t stream = 0) const {
    return Rng(seed, RandomPurpose::sensor_noise, robot, static_cast<std::uint32_t>(slot) | stream << 20, time.step);
  }
};

/// One kind of sensor with one set of options, as mounted on all robots of a model. sense() handles many robots at once
/// and writes only to each robot's own slot, so robots may be distributed over threads arbitrarily.
class Sensor {
 public:
  virtual ~Sensor() = default;

  virtual const SensorInfo& info() const = 0;
  /// The measurement before the first step.
  virtual Measurement blank() const { return blankMeasurement(info()); }
  /// Number of rays or sectors per step; determines the sensor's memory.
  virtual std::size_t rayCount() const { return info().beams.size(); }
  /// Whether its measurements depend on the run's seed.
  virtual bool isNoisy() const { return false; }
  /// Whether sense() runs in the process that hosts the run, after all sensors of which replicas may compute the
  /// measurements: those of Echoes without needsHostProcess(). All other kinds are cheaper to compute than to transmit,
  /// or depend on the step before, on other sensors or on an ImageSource.
  bool sensesInHostProcess() const { return !measuresEchoes(info()) || needsHostProcess(); }
  /// Of a sensor of Echoes: whether its measurement depends on more than the present state of the world, such as its
  /// measurement in the step before. Without effect for other kinds.
  virtual bool needsHostProcess() const { return false; }
  /// Whether sense() casts its beams with the robot as owner, whose neighbours then cover the beams.
  virtual bool usesNeighbours() const { return true; }
  /// The slot before its own whose measurement it reads: a camera that of its head, a blob finder that of its camera.
  virtual std::optional<std::size_t> slotRead() const { return std::nullopt; }
  /// Whether it reads Snapshot::former_motion.
  virtual bool usesFormerMotion() const { return false; }
  /// Distance from its robot's centre beyond which no part of another robot affects its measurement [m]; infinite if
  /// there is no such distance. Ranks of a distributed run have the state of the robots within it only.
  /// @param speed_max_mps of its robot
  virtual double robotReach(double speed_max_mps) const {
    static_cast<void>(speed_max_mps);
    return std::numeric_limits<double>::infinity();
  }
  /// Replaces readings[r].measurements[slot] for each r of `robots`; the old value is that of the step before, and is
  /// the only memory of a sensor. A sensor with sensesInHostProcess() may read slots before its own, which are already
  /// updated.
  virtual void sense(const Snapshot&, std::span<const std::uint32_t> robots, std::size_t slot,
                     std::span<Readings> readings) const = 0;
};

}  // namespace robosim
