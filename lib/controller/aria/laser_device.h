#pragma once
#include <vector>

#include "aria/range_device.h"
#include "aria/sensor_reading.h"

namespace robosim {

/// The robot's laser as a range device, as ARIA's ArLaser. The current buffer contains the echoes of the latest scan.
/// The cumulative buffer contains points within 3 m of the robot when they were measured (setMaxInsertDistCumulative())
/// that are at least 200 mm apart (setMinDistBetweenCumulative()), for at most 30 s and within 4 m of the robot. Once
/// per second, points are removed that the latest scan passes through.
class LaserDevice : public RangeDevice {
 public:
  explicit LaserDevice(std::size_t current_size = 1081, std::size_t cumulative_size = 200, std::string name = "laser");

  /// Minimum distance [mm] of a point from the point before it in the current buffer; 0, the default, keeps all.
  void setMinDistBetweenCurrent(double mm) { gap_current_ = mm; }
  double getMinDistBetweenCurrent() const { return gap_current_; }
  void setMinDistBetweenCumulative(double mm) { gap_cumulative_ = mm; }
  double getMinDistBetweenCumulative() const { return gap_cumulative_; }
  void setMaxInsertDistCumulative(double mm) { insert_cumulative_ = mm; }
  double getMaxInsertDistCumulative() const { return insert_cumulative_; }
  /// Points nearer than this [mm] to a beam, and farther than this before its end, are removed.
  void setCumulativeCleanDist(double mm) { clean_distance_ = mm; }
  double getCumulativeCleanDist() const { return clean_distance_; }
  /// Interval [ms] of that check; 0 or less for none.
  void setCumulativeCleanInterval(double ms) { clean_interval_ms_ = ms; }
  double getCumulativeCleanInterval() const { return clean_interval_ms_; }

  /// All beams of the latest scan, in the order of the laser; those without an echo have the laser's maximum range.
  const std::vector<SensorReading>& getRawReadings() const { return raw_; }

 protected:
  void processReadings(PioneerRobot& robot) override;

 private:
  void addCurrent(const PioneerRobot& robot);
  void clean(const PioneerRobot& robot);
  void addCumulative(const PioneerPose& pose);

  double gap_current_ = 0, gap_cumulative_ = 200, insert_cumulative_ = 3000;
  double clean_distance_ = 75, clean_interval_ms_ = 1000;
  double last_clean_s_ = 0;
  std::vector<SensorReading> raw_;
};

}  // namespace robosim
