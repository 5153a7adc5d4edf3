#include "replay/observation_csv.h"

#include <utility>

#include "base/text_table.h"
#include "replay/csv_field.h"
#include "replay/observation_row.h"

namespace robosim {
namespace {

template <typename Fields>
std::string joined(const Fields& fields) {
  std::string line;
  for (const auto& one : fields) line += "," + csvField(one);
  return line + "\n";
}

}  // namespace

std::string ObservationCsv::lines(const mrpt::obs::CObservation& observation, double time_s, const SensorInfo* sensor) {
  const ObservationRow row = ObservationRow::of(observation, sensor);
  const std::string label = csvField(observation.sensorLabel);
  std::string text;
  const std::string names = "seconds,label" + joined(row.names);
  if (std::exchange(names_[label], names) != names) text = names;
  return text + fixed(time_s, 7) + "," + label + joined(row.values);
}

}  // namespace robosim
