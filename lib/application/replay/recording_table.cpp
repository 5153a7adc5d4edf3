#include "replay/recording_table.h"

#include <algorithm>
#include <cmath>

#include "base/error_list.h"
#include "base/label.h"
#include "base/text_table.h"
#include "replay/value_text.h"

namespace robosim {
namespace {

using Kind = RecordedColumn::Kind;

struct KindOf {
  Kind operator()(std::monostate) const { return Kind::unknown; }
  Kind operator()(std::int64_t) const { return Kind::integer; }
  Kind operator()(float) const { return Kind::single; }
  Kind operator()(double) const { return Kind::real; }
  Kind operator()(const std::string&) const { return Kind::text; }
};

struct AsNumber {
  double operator()(std::monostate) const { return std::numeric_limits<double>::quiet_NaN(); }
  double operator()(const std::string&) const { return std::numeric_limits<double>::quiet_NaN(); }
  double operator()(auto number) const { return static_cast<double>(number); }
};

Kind common(Kind a, Kind b) {
  if (a == b || b == Kind::unknown) return a;
  return a == Kind::unknown ? b : Kind::real;
}

}  // namespace

ColumnValue RecordedColumn::value(std::size_t row) const {
  if (kind == Kind::text) return row < texts.size() && !texts[row].empty() ? ColumnValue(texts[row]) : ColumnValue();
  const double value = number(row);
  if (std::isnan(value)) return {};
  if (kind == Kind::integer) return static_cast<std::int64_t>(value);
  if (kind == Kind::single) return static_cast<float>(value);
  return value;
}

void RecordingTable::add(const mrpt::obs::CObservation& observation, double time_s, const SensorInfo* sensor) {
  add(observation, time_s, ObservationRow::of(observation, sensor));
}

void RecordingTable::add(const mrpt::obs::CObservation& observation, double time_s, ObservationRow values) {
  if (!series_.empty() && time_s != last_s_) ++step_;
  last_s_ = time_s;
  const std::size_t index = findOrAddSeries(observation);
  const std::size_t row = series_[index].steps.size();
  for (std::size_t i = 0; i < values.names.size(); ++i) {
    const bool is_text = std::holds_alternative<std::string>(values.values[i]);
    set(findOrAddColumn(index, i, values.names[i], is_text), row, std::move(values.values[i]));
  }
  count(2);
  series_[index].steps.push_back(step_);
  series_[index].times_s.push_back(time_s);
  group(index, row, time_s);
}

std::size_t RecordingTable::findOrAddSeries(const mrpt::obs::CObservation& observation) {
  const std::string label = observation.sensorLabel.empty() ? classOf(observation) : observation.sensorLabel;
  const auto [found, is_new] = series_by_label_.try_emplace(label, series_.size());
  if (is_new) {
    const Label parts = Label::parse(label);
    series_.push_back({label, parts.robot, parts.withinRobot(), {}, {}, {}});
    columns_.emplace_back();
  }
  return found->second;
}

/// @param guess index of the column unless the columns have changed
RecordedColumn& RecordingTable::findOrAddColumn(std::size_t series, std::size_t guess, const std::string& name,
                                                bool is_text) {
  auto& columns = series_[series].columns;
  if (guess < columns.size() && columns[guess].name == name && (columns[guess].kind == Kind::text) == is_text) {
    return columns[guess];
  }
  const auto [found, is_new] = columns_[series].try_emplace({name, is_text}, columns.size());
  if (is_new) columns.push_back({name, is_text ? Kind::text : Kind::unknown, {}, {}});
  return columns[found->second];
}

void RecordingTable::set(RecordedColumn& column, std::size_t row, ColumnValue value) {
  // A name may occur twice in an observation of another program; the last value is kept.
  column.kind = common(column.kind, std::visit(KindOf(), value));
  if (auto* text = std::get_if<std::string>(&value)) {
    const std::size_t added = row + 1 - std::min(row, column.texts.size());
    count((text->size() + added * sizeof(std::string)) / sizeof(double));
    column.texts.resize(row);
    column.texts.push_back(std::move(*text));
    return;
  }
  if (column.numbers.size() <= row) {
    count(row + 1 - column.numbers.size());
    column.numbers.resize(row + 1, std::numeric_limits<double>::quiet_NaN());
  }
  column.numbers[row] = std::visit(AsNumber(), value);
}

void RecordingTable::group(std::size_t series, std::size_t row, double time_s) {
  const std::string& robot = series_[series].robot;
  const auto [found, is_new] = last_rows_.try_emplace(robot, rows_.size());
  const auto is_taken = [&](const Row& group) {
    return std::any_of(group.observations.begin(), group.observations.end(),
                       [series](const auto& observation) { return observation.first == series; });
  };
  if (is_new || rows_[found->second].time_s != time_s || is_taken(rows_[found->second])) {
    found->second = rows_.size();
    rows_.push_back({step_, time_s, robot, {}});
  }
  rows_[found->second].observations.emplace_back(series, row);
}

void RecordingTable::count(std::uint64_t values) {
  values_ += values;
  if (values_ <= kMaxValues) return;
  throw ConfigError("the recording has more than " + withCommas(kMaxValues) +
                    " values, the limit of an export; select a part with: robosim replay RAWLOG --robot NAME --from "
                    "SECONDS --to SECONDS --output PART.rawlog");
}

}  // namespace robosim
