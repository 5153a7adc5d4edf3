#pragma once
#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <mrpt/obs/CObservation.h>

#include "hardware/sensor_info.h"
#include "replay/observation_row.h"
#include "replay/recorded_series.h"

namespace robosim {

/// The observations of a recording in memory: a series for each label, and the rows of all, grouped by robot and time.
class RecordingTable {
 public:
  /// Limit of the number of values in memory, of 8 bytes each.
  static constexpr std::uint64_t kMaxValues = std::uint64_t{1} << 28;

  /// The observations of a robot at one time, at most one of each label.
  struct Row {
    std::uint64_t step;
    double time_s;
    std::string robot;
    std::vector<std::pair<std::size_t, std::size_t>> observations;  ///< series, row of the series
  };

  /// @param time_s since the recording's first observation. The step is the number of changes of the time so far: in a
  ///   recording of RoboSim, the time step.
  /// @param sensor its description (RecordedSensors); null if unknown
  /// @throws ConfigError above kMaxValues
  void add(const mrpt::obs::CObservation& observation, double time_s, const SensorInfo* sensor = nullptr);
  /// The same of an observation whose values are known.
  void add(const mrpt::obs::CObservation& observation, double time_s, ObservationRow values);

  const std::vector<RecordedSeries>& series() const { return series_; }
  std::vector<RecordedSeries> takeSeries() && { return std::move(series_); }
  const std::vector<Row>& rows() const { return rows_; }

 private:
  std::size_t findOrAddSeries(const mrpt::obs::CObservation& observation);
  RecordedColumn& findOrAddColumn(std::size_t series, std::size_t guess, const std::string& name, bool is_text);
  void set(RecordedColumn& column, std::size_t row, ColumnValue value);
  void group(std::size_t series, std::size_t row, double time_s);
  void count(std::uint64_t values);

  std::vector<RecordedSeries> series_;
  std::vector<Row> rows_;
  std::map<std::string, std::size_t> series_by_label_;
  std::vector<std::map<std::pair<std::string, bool>, std::size_t>> columns_;  ///< by series; by name and is_text
  std::map<std::string, std::size_t> last_rows_;                              ///< by robot
  std::uint64_t step_ = 0, values_ = 0;
  double last_s_ = std::numeric_limits<double>::quiet_NaN();  ///< time of the last observation
};

}  // namespace robosim
