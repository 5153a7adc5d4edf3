#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "environment/environment.h"
#include "recording/rawlog_writer.h"
#include "run/outputs/run_note.h"
#include "run/outputs/world_topics.h"
#include "run/run_summary.h"

namespace robosim {

struct RecordingOptions {
  std::filesystem::path file;  ///< of the first part
  RawlogFormat format = RawlogFormat::observations;
  RawlogImages images = RawlogImages::embedded;
  RosDistribution distribution = RosDistribution::jazzy;  ///< of an MCAP file
};

/// Recording of a run, in one or more parts: each start after a stop opens the next file, "run_part2.rawlog".
class RunRecording {
 public:
  /// The recording is off until open() or openNext(). @param note of the run, without outcome @param model of the run
  RunRecording(RecordingOptions options, std::vector<RobotInfo> robots, RunNote note,
               std::shared_ptr<const Model> model);

  /// Continues with a fleet that has further robots, the last.
  void follow(const Fleet& fleet);
  bool isOn() const { return writer_ != nullptr; }
  /// The current or last part; empty before the first.
  const std::filesystem::path& file() const { return file_; }
  /// Files of all parts, in their order.
  const std::vector<std::filesystem::path>& files() const { return files_; }

  /// Starts with the first step of the run, in `options.file`, which replaces an older file when it is complete.
  /// @throws ConfigError
  void open();
  /// Starts with the current step, or with the next if the previous part ends with the current one, so that no step is
  /// in two parts; in the first file of options.file, "_part2", "_part3", … that does not exist.
  /// @throws ConfigError
  void openNext(const State& state);
  /// Records the current step; no effect while the recording is off, or for the step recorded last. When a part of
  /// openNext() cannot be written, it is discarded, the recording is off, and failure() states the reason.
  /// @throws RecordingError when the part of open() cannot be written
  void write(const State& state);
  /// Completes the current part, whose last note has this outcome; no effect while the recording is off.
  /// @param state the present one, with the interventions since the last step
  /// @throws RecordingError when the part cannot be completed: it is discarded, and the recording is off.
  void close(const State& state, const RunSummary& outcome);
  /// close() at the end of the run. When a part of openNext() cannot be completed, failure() states the reason.
  /// @throws RecordingError when the part of open() cannot be completed
  void finish(const State& state, const RunSummary& outcome);
  /// Why write() or finish() has discarded the last part; empty if they have not.
  const std::string& failure() const { return failure_; }
  /// Completes the current part without a last note. @throws RecordingError
  void keep();

 private:
  void open(const std::filesystem::path& file, const SimTime& start, const ChangedObjects& objects);
  std::filesystem::path part(int number) const;
  void discard(RawlogWriter& writer);
  bool isFree(const std::filesystem::path& file) const;

  RecordingOptions options_;
  std::vector<RobotInfo> robots_;
  RunNote note_;
  std::unique_ptr<RawlogWriter> writer_;  ///< null while the recording is off
  std::size_t recorded_robots_ = 0;       ///< number of those that the writer has
  bool is_requested_ = false;             ///< the current or last part is of openNext()
  bool is_new_part_ = false;              ///< no step of the part has been written
  ChangedObjects objects_;                ///< of the step recorded last
  std::size_t moved_notes_ = 0;           ///< number since the last list of all objects
  std::shared_ptr<const Model> model_;
  WorldTopics topics_;  ///< of an MCAP file
  std::string failure_;
  std::optional<std::uint64_t> last_step_;  ///< recorded
  std::filesystem::path file_, previous_file_;
  std::vector<std::filesystem::path> files_;
};

}  // namespace robosim
