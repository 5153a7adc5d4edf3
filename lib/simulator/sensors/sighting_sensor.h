#pragma once
#include <cmath>
#include <vector>

#include "sensors/range_noise.h"
#include "sensors/registry.h"

namespace robosim {

/// Something that a sensor may see.
struct Sighting {
  double what = 0;  ///< first value of its record
  mrpt::math::TPoint3D at;
  BodyId body = kNoBody;
  double heading_rad = 0;  ///< of its x axis, world frame
  double distance_m = 0;   ///< from the sensor, in plan; set by SightingSensor
};

/// Settings of a SightingSensor.
struct SightingOptions {
  SensorInfo info;                      ///< its only beam is the sensor's place and direction
  std::size_t count = 16;               ///< largest number of sightings, [1, 64]
  double field_of_view_rad = 2 * M_PI;  ///< about the sensor's direction, (0, 2π]
  double what_range_m = 1e9;            ///< of a farther thing the first value is 0
  RangeNoise noise;
  double bearing_std_rad = 0;  ///< [0, π]

  /// Reads count, range_max_m, x_m, y_m, z_m, angle_deg, field_of_view_deg and <noise> of a sensor.
  /// @param z_m default of its height @param quantities of a number of sightings (hardware/numbered_quantities.h)
  static SightingOptions read(XmlReader&, const char* label, double range_max_m, double z_m,
                              std::vector<Quantity> (*quantities)(std::size_t count));
};

/// A sensor that measures where things in line of sight are, the nearest first: in records of what a thing is, range
/// [m] and bearing [rad], counter-clockwise from the sensor's direction, (-π, π]; in records of four values also the
/// orientation of the thing [rad] in the sensor's frame. Ranges are in plan. A record without a thing is -1, 0, 0, ….
class SightingSensor : public Sensor {
 public:
  explicit SightingSensor(const SightingOptions& options);
  const SensorInfo& info() const override { return options_.info; }
  bool isNoisy() const override { return options_.noise.on; }
  std::size_t rayCount() const override { return options_.count; }
  bool usesNeighbours() const override { return false; }  // what is seen is farther away
  double robotReach(double) const override;
  Measurement blank() const override;
  void sense(const Snapshot& now, std::span<const std::uint32_t> robots, std::size_t slot,
             std::span<Readings> readings) const override;

 protected:
  /// Appends all things that a robot may see within a distance, hidden or not; farther ones, too.
  virtual void find(const Snapshot& now, std::uint32_t robot, double range_m, std::vector<Sighting>& all) const = 0;

 private:
  /// Writes a record. @param heading_rad of the sensor @return false for a measurement that is lost
  bool measure(const Sighting& thing, double bearing_rad, double heading_rad, Rng& rng, double* record) const;

  SightingOptions options_;
  std::size_t record_;  ///< values of a record
};

}  // namespace robosim
