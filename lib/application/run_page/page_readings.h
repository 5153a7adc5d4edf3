#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

namespace robosim {

/// Readings of all robots for the page of a run. Of each sensor, those of every n-th reading of each robot are kept: n
/// is a power of two, doubled for the sensor that takes most until all fit into a page. Numbers are rounded to a step,
/// a power of ten, of which the values of a column span 1,000 to 10,000 (metres and radians: at most 0.001; 12 digits
/// at most); whole numbers up to 2e15 are exact.
class PageReadings {
 public:
  /// Bound of the numbers in memory, of 8 bytes each.
  static constexpr std::size_t kMaxValues = 16'000'000;
  /// Bound of the columns of all sensors.
  static constexpr std::size_t kMaxColumns = 50'000;

  /// Readings of a sensor as they are stored in a page.
  struct Block {
    nlohmann::ordered_json head;  ///< columns and series, as readings.js documents them
    std::string packed;           ///< packedForPage()
  };

  /// @name Adding a reading: first whether it is kept, then its values
  ///@{
  /// Whether the next reading of a sensor of a robot is kept. If so, continue with add().
  bool keepsNext(std::size_t robot, const std::string& sensor);
  /// @param names columns, of which several with the same name are one
  /// @param values as many; NaN for none
  /// @param is_whole by column: whether the number is an integer by its kind
  void add(std::size_t robot, const std::string& sensor, std::uint64_t moment, const std::vector<std::string>& names,
           const std::vector<double>& values, const std::vector<std::uint8_t>& is_whole);
  ///@}

  /// Sentences about what was left out because of these bounds.
  std::vector<std::string> remarks() const;

  /// Encodes all sensors in at most this many bytes of text, unless each has one reading only.
  /// @param progress called before each sensor is encoded
  std::vector<Block> encode(std::size_t budget_bytes, const std::function<void(const std::string& sensor)>& progress);

 private:
  /// Readings of a sensor of a robot.
  struct Series {
    std::size_t robot = 0;
    std::uint64_t seen = 0;                       ///< readings so far
    std::vector<std::size_t> columns;             ///< of the sensor, in the order of the values
    std::vector<std::uint64_t> moments;           ///< of the kept readings
    std::vector<double> values;                   ///< row by row
    std::vector<std::size_t> row_columns;         ///< number of values in each row, of the first columns
    std::map<std::size_t, std::size_t> place_of;  ///< by column, in `columns`: of those whose place is not their index
  };
  struct Column {
    std::string name;
    bool is_whole = true;
    double min = 0, max = 0;
    bool is_empty = true;
  };
  struct Sensor {
    std::string name;
    std::uint64_t stride = 1;
    std::size_t values = 0;
    std::vector<Column> columns;
    std::map<std::string, std::size_t> column_of;
    std::vector<Series> series;
    std::map<std::size_t, std::size_t> series_of;  ///< by robot
  };

  Sensor& sensorNamed(const std::string& name);
  static Series& seriesOf(Sensor& sensor, std::size_t robot);
  std::size_t placeOf(Sensor& sensor, Series& series, const std::string& name, std::size_t guess);
  static bool canBeThinned(const Sensor& sensor);
  static void thin(Sensor& sensor);
  static Block encode(const Sensor& sensor);
  void bound();

  std::vector<Sensor> sensors_;
  std::map<std::string, std::size_t> sensor_of_;
  std::size_t values_ = 0, columns_ = 0;
  bool is_full_ = false;
  std::size_t left_out_readings_ = 0, left_out_columns_ = 0;  ///< the latter: values
};

/// The step to which the values of a column are rounded.
double roundingStep(std::string_view name, bool is_whole, double min, double max);

}  // namespace robosim
