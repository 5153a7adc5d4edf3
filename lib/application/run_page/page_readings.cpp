#include "run_page/page_readings.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/text_table.h"
#include "run_page/page_bytes.h"

namespace robosim {
namespace {

using nlohmann::ordered_json;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kNoPlace = std::numeric_limits<std::size_t>::max();

}  // namespace

double roundingStep(std::string_view name, bool is_whole, double min, double max) {
  // The code of a difference is at most 4 * kExact + 2, which is exact in JavaScript: less than 2^53.
  constexpr double kExact = 2e15;
  constexpr int kDigits = 12;                       // that a value has at most
  constexpr double kLeast = 1e-300, kMost = 1e300;  // the inverse is finite, too
  const double most = std::max(std::abs(min), std::abs(max));
  if (is_whole && most <= kExact) return 1;
  const bool is_length_or_angle = name.ends_with("_m") || name.ends_with("_rad");
  const double span = max - min;
  const auto power = [](double of, int fewer) { return std::pow(10, std::floor(std::log10(of)) - fewer); };
  double step = 1;
  if (span > 0) {
    step = power(span, 3);
    if (is_length_or_angle) step = std::min(step, 1e-3);
  } else if (is_length_or_angle) {
    step = 1e-4;
  } else if (most > 0) {
    step = power(most, 5);
  }
  if (most > 0) step = std::max(step, power(most, kDigits - 1));
  return std::clamp(step, kLeast, kMost);
}

PageReadings::Sensor& PageReadings::sensorNamed(const std::string& name) {
  const auto [found, is_new] = sensor_of_.try_emplace(name, sensors_.size());
  if (is_new) {
    sensors_.emplace_back();
    sensors_.back().name = name;
  }
  return sensors_[found->second];
}

PageReadings::Series& PageReadings::seriesOf(Sensor& sensor, std::size_t robot) {
  const auto [found, is_new] = sensor.series_of.try_emplace(robot, sensor.series.size());
  if (is_new) {
    sensor.series.emplace_back();
    sensor.series.back().robot = robot;
  }
  return sensor.series[found->second];
}

bool PageReadings::keepsNext(std::size_t robot, const std::string& name) {
  if (is_full_) {
    ++left_out_readings_;
    return false;
  }
  Sensor& sensor = sensorNamed(name);
  return seriesOf(sensor, robot).seen++ % sensor.stride == 0;
}

void PageReadings::add(std::size_t robot, const std::string& name, std::uint64_t moment,
                       const std::vector<std::string>& names, const std::vector<double>& values,
                       const std::vector<std::uint8_t>& is_whole) {
  Sensor& sensor = sensorNamed(name);
  Series& series = seriesOf(sensor, robot);
  std::vector<double> row(series.columns.size(), kNone);
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::size_t at = placeOf(sensor, series, names[i], i);
    if (at == kNoPlace) continue;
    if (at == row.size()) row.push_back(kNone);
    row[at] = values[i];
    if (!std::isfinite(values[i])) {
      row[at] = kNone;
      continue;
    }
    Column& column = sensor.columns[series.columns[at]];
    column.is_whole = column.is_whole && is_whole[i];
    column.min = column.is_empty ? values[i] : std::min(column.min, values[i]);
    column.max = column.is_empty ? values[i] : std::max(column.max, values[i]);
    column.is_empty = false;
  }
  series.moments.push_back(moment);
  series.row_columns.push_back(row.size());
  series.values.insert(series.values.end(), row.begin(), row.end());
  sensor.values += row.size();
  values_ += row.size();
  if (values_ > kMaxValues) bound();
}

/// Index of a column in the rows of a series, which is their number for a new one; kNoPlace if there are too many.
std::size_t PageReadings::placeOf(Sensor& sensor, Series& series, const std::string& name, std::size_t guess) {
  // The columns of a reading are nearly always those of the one before.
  if (guess < series.columns.size() && sensor.columns[series.columns[guess]].name == name) return guess;
  const auto known = sensor.column_of.find(name);
  std::size_t column = sensor.columns.size();
  if (known != sensor.column_of.end()) {
    column = known->second;
    if (column < series.columns.size() && series.columns[column] == column) return column;
    const auto place = series.place_of.find(column);
    if (place != series.place_of.end()) return place->second;
  } else {
    if (columns_ == kMaxColumns) {
      ++left_out_columns_;
      return kNoPlace;
    }
    ++columns_;
    sensor.column_of.emplace(name, column);
    sensor.columns.emplace_back();
    sensor.columns.back().name = name;
  }
  const std::size_t place = series.columns.size();
  if (place != column) series.place_of.emplace(column, place);
  series.columns.push_back(column);
  return place;
}

/// Thins the sensors that take most until half of the bound is free. Where each series has one reading only, further
/// readings are refused.
void PageReadings::bound() {
  while (values_ > kMaxValues / 2) {
    Sensor* most = nullptr;
    for (auto& sensor : sensors_) {
      if (canBeThinned(sensor) && (!most || sensor.values > most->values)) most = &sensor;
    }
    if (!most) {
      is_full_ = values_ > kMaxValues;
      return;
    }
    const std::size_t before = most->values;
    thin(*most);
    values_ -= before - most->values;
  }
}

bool PageReadings::canBeThinned(const Sensor& sensor) {
  return std::any_of(sensor.series.begin(), sensor.series.end(),
                     [](const Series& series) { return series.moments.size() > 1; });
}

std::vector<std::string> PageReadings::remarks() const {
  std::vector<std::string> remarks;
  if (left_out_readings_ > 0) {
    remarks.push_back("The page does not contain the last " + withCommas(left_out_readings_) +
                      " readings: the recording has too many sensors.");
  }
  if (left_out_columns_ > 0) {
    remarks.push_back("Of the readings, the page contains " + withCommas(kMaxColumns) +
                      " quantities; values of others are left out: " + withCommas(left_out_columns_) + ".");
  }
  return remarks;
}

/// Keeps every other reading.
void PageReadings::thin(Sensor& sensor) {
  sensor.stride *= 2;
  sensor.values = 0;
  for (auto& series : sensor.series) {
    std::size_t kept = 0, from = 0, to = 0;
    for (std::size_t row = 0; row < series.moments.size(); ++row) {
      const std::size_t size = series.row_columns[row];
      if (row % 2 == 0) {
        series.moments[kept] = series.moments[row];
        series.row_columns[kept++] = size;
        std::copy_n(series.values.begin() + static_cast<std::ptrdiff_t>(from), size,
                    series.values.begin() + static_cast<std::ptrdiff_t>(to));
        to += size;
      }
      from += size;
    }
    series.moments.resize(kept);
    series.row_columns.resize(kept);
    series.values.resize(to);
    sensor.values += to;
  }
}

PageReadings::Block PageReadings::encode(const Sensor& sensor) {
  std::vector<double> steps;
  ordered_json columns = ordered_json::array();
  for (const auto& column : sensor.columns) {
    steps.push_back(roundingStep(column.name, column.is_whole, column.min, column.max));
    columns.push_back({column.name, steps.back()});
  }
  PageBytes bytes;
  ordered_json lists = ordered_json::array(), all_series = ordered_json::array();
  std::map<std::vector<std::size_t>, std::size_t> list_of;
  for (const auto& series : sensor.series) {
    const auto [list, is_new] = list_of.try_emplace(series.columns, lists.size());
    if (is_new) lists.push_back(series.columns);
    all_series.push_back({series.robot, list->second, series.moments.size()});
    std::uint64_t moment = 0;
    for (const std::uint64_t at : series.moments) bytes.add(at - std::exchange(moment, at));
    for (std::size_t c = 0; c < series.columns.size(); ++c) {
      const double step = steps[series.columns[c]];
      std::int64_t before = 0;
      std::size_t begin = 0;
      for (const std::size_t size : series.row_columns) {
        const double value = c < size ? series.values[begin + c] : kNone;
        begin += size;
        if (std::isnan(value)) {
          bytes.add(0);
          continue;
        }
        // Zero stands for no value: a difference is stored as PageBytes::addSigned() does, plus 1.
        const auto rounded = static_cast<std::int64_t>(std::llround(value / step));
        const std::int64_t difference = rounded - std::exchange(before, rounded);
        bytes.add((difference < 0 ? 2 * static_cast<std::uint64_t>(-difference) - 1
                                  : 2 * static_cast<std::uint64_t>(difference)) +
                  1);
      }
    }
  }
  return {{{"sensor", sensor.name},
           {"stride", sensor.stride},
           {"columns", std::move(columns)},
           {"lists", std::move(lists)},
           {"series", std::move(all_series)}},
          packedForPage(bytes.bytes())};
}

std::vector<PageReadings::Block> PageReadings::encode(std::size_t budget_bytes,
                                                      const std::function<void(const std::string&)>& progress) {
  std::vector<Block> blocks;
  std::size_t total = 0;
  for (const auto& sensor : sensors_) {
    progress(sensor.name);
    blocks.push_back(encode(sensor));
    total += blocks.back().packed.size();
  }
  while (total > budget_bytes) {
    std::size_t most = blocks.size();
    for (std::size_t i = 0; i < blocks.size(); ++i) {
      if (!canBeThinned(sensors_[i])) continue;
      if (most == blocks.size() || blocks[i].packed.size() > blocks[most].packed.size()) most = i;
    }
    if (most == blocks.size()) break;
    Sensor& sensor = sensors_[most];
    progress(sensor.name);
    total -= blocks[most].packed.size();
    thin(sensor);
    blocks[most] = encode(sensor);
    total += blocks[most].packed.size();
  }
  return blocks;
}

}  // namespace robosim
