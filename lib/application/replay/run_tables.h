#pragma once
#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/temporary_directory.h"
#include "environment/environment.h"
#include "recording/rawlog_writer.h"
#include "replay/export_recording.h"
#include "run/outputs/run_note.h"

namespace robosim {

/// Tables of a run: those that exportRecording() writes of its recording, which is a temporary file.
class RunTables {
 public:
  /// @param tables may be empty  @param world its file  @param note of the recording
  /// @throws ConfigError for a file that cannot be written or is an input of the run
  RunTables(std::vector<RecordingOutput> tables, const std::string& world, const Environment& environment,
            const RunNote& note);

  void observe(const Environment& environment);  ///< records the current step @throws RecordingError
  void finish();                                 ///< writes the tables @throws RecordingError @throws ConfigError
  void keep() noexcept;                          ///< writes those of a failed run, with its steps so far, if possible
  const std::vector<RecordingOutput>& tables() const { return tables_; }

 private:
  /// Named as the first table, because a page has this title; where names with ".rawlog" are too long for a file,
  /// "run".
  std::filesystem::path rawlog() const {
    constexpr std::size_t kMax_bytes = 240;
    const std::string name = tables_.front().file.stem().string();
    return *folder_ / ((name.size() <= kMax_bytes ? name : "run") + ".rawlog");
  }

  std::vector<RecordingOutput> tables_;
  std::optional<TemporaryDirectory> folder_;
  std::unique_ptr<RawlogWriter> recording_;
  std::size_t robots_ = 0;  ///< number of those that it has
};

}  // namespace robosim
