#pragma once
#include <cstdint>
#include <limits>
#include <string>
#include <variant>
#include <vector>

namespace robosim {

/// Value of a column; none: nothing was measured, such as an absent echo.
using ColumnValue = std::variant<std::monostate, float, double, std::int64_t, std::string>;

/// A column of a series: numbers, or texts.
struct RecordedColumn {
  enum class Kind { unknown, integer, single, real, text };  ///< unknown: without any value so far

  std::string name;                ///< ends in a unit: "range_3_m"
  Kind kind = Kind::unknown;       ///< of all values
  std::vector<double> numbers;     ///< by row; NaN for none; rows after the last have none
  std::vector<std::string> texts;  ///< likewise, if kind is text

  double number(std::size_t row) const {
    return row < numbers.size() ? numbers[row] : std::numeric_limits<double>::quiet_NaN();
  }
  /// The value in its precision; none for NaN.
  ColumnValue value(std::size_t row) const;
};

/// All observations of one label, as rows.
struct RecordedSeries {
  std::string label;          ///< "Pioneer1/sonar"; the class of an observation without label
  std::string robot, sensor;  ///< of the label
  std::vector<std::uint64_t> steps;
  std::vector<double> times_s;          ///< as many as steps
  std::vector<RecordedColumn> columns;  ///< in the order of their first appearance
};

}  // namespace robosim
