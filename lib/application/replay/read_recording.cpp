#include "replay/read_recording.h"

#include <memory>
#include <utility>

#include <mrpt/obs/CObservationComment.h>

#include "recording/observation_times.h"
#include "recording/rawlog_reader.h"
#include "replay/recorded_sensors.h"
#include "run/outputs/run_note.h"

namespace robosim {

RecordingContents readRecording(const std::string& rawlog, const RecordingParts& parts,
                                const std::function<void(std::uint64_t)>& progress, int threads) {
  std::optional<RecordedSensors> sensors;  // outlives the reader, whose threads use it
  RawlogReader reader(rawlog, RawlogReader::Access::sequential, threads);
  RecordingContents read;
  if (parts.table) read.table.emplace();
  if (parts.figure) read.figure.emplace(rawlog);
  if (parts.page) read.page.emplace(rawlog, parts.layers, parts.only);
  ObservationTimes times(rawlog);
  const auto row_of = [&sensors](const mrpt::obs::CObservation& observation) {
    return ObservationRow::of(observation, sensors ? sensors->find(observation.sensorLabel) : nullptr);
  };
  while (const auto observation = reader.next()) {
    if (progress) progress(reader.entries());
    if (const auto* comment = dynamic_cast<const mrpt::obs::CObservationComment*>(observation.get())) {
      if (sensors) {
        if (read.figure) read.figure->addComment(comment->text);
        if (read.page) read.page->addComment(comment->text);
        continue;
      }
      if (const auto note = RunNote::parse(comment->text)) {
        sensors = RecordedSensors::of(*note);
        if (read.figure) read.figure->setRun(*note);
        if (read.page) read.page->setRun(*note);
        // Most of the time of a table is that of its rows.
        if (read.table) {
          reader.prepareWith([row_of](const auto& each) { return std::make_shared<ObservationRow>(row_of(each)); });
        }
      }
      continue;
    }
    const double time_s = times.of(*observation, reader.entries());
    if (read.figure) read.figure->add(*observation, time_s);
    if (read.page) {
      read.page->add(*observation, time_s, sensors ? sensors->find(observation->sensorLabel) : nullptr);
    }
    if (!read.table) continue;
    const auto row = std::static_pointer_cast<ObservationRow>(reader.prepared());
    read.table->add(*observation, time_s, row ? std::move(*row) : row_of(*observation));
  }
  read.read_error = reader.readError();
  read.is_damaged = reader.isDamaged();
  read.unread = reader.unread();
  read.assumptions = reader.assumptions();
  return read;
}

}  // namespace robosim
