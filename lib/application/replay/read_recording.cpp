#include "replay/read_recording.h"

#include <mrpt/obs/CObservationComment.h>

#include "recording/observation_times.h"
#include "recording/rawlog_reader.h"
#include "replay/recorded_sensors.h"
#include "run/outputs/run_note.h"

namespace robosim {

RecordingContents readRecording(const std::string& rawlog, const RecordingParts& parts,
                                const std::function<void(std::uint64_t)>& progress) {
  RawlogReader reader(rawlog);
  RecordingContents read;
  if (parts.table) read.table.emplace();
  if (parts.figure) read.figure.emplace(rawlog);
  ObservationTimes times(rawlog);
  std::optional<RecordedSensors> sensors;
  while (const auto observation = reader.next()) {
    if (progress) progress(reader.entries());
    if (const auto* comment = dynamic_cast<const mrpt::obs::CObservationComment*>(observation.get())) {
      if (sensors) {
        if (read.figure) read.figure->addComment(comment->text);
        continue;
      }
      if (const auto note = RunNote::parse(comment->text)) {
        sensors = RecordedSensors::of(*note);
        if (read.figure) read.figure->setRun(*note);
      }
      continue;
    }
    const double time_s = times.of(*observation, reader.entries());
    if (read.figure) read.figure->add(*observation, time_s);
    if (read.table) read.table->add(*observation, time_s, sensors ? sensors->find(observation->sensorLabel) : nullptr);
  }
  read.read_error = reader.readError();
  read.is_damaged = reader.isDamaged();
  read.unread = reader.unread();
  read.assumptions = reader.assumptions();
  return read;
}

}  // namespace robosim
