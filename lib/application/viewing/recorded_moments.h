#pragma once
#include <atomic>
#include <future>
#include <memory>
#include <string>
#include <vector>

#include "recording/recorded_step.h"
#include "rendering/drawn_run.h"
#include "rendering/run_paths.h"
#include "robots/run_snapshot.h"
#include "robots/world_source.h"

namespace robosim {

/// Index of the moments of a recording. A few numbers are kept per moment, and a moment is read again when it is shown.
class RecordedMoments {
 public:
  virtual ~RecordedMoments() = default;

  /// For RoboSim's recordings, the recorded world; for others, only robots.
  virtual const LoadedWorld& world() const = 0;
  /// Reads on, of openMoments(): adds the next moment. @return false at the end, and for a recording that was read in
  /// full
  virtual bool extend() { return false; }
  /// Whether the moments are all: then extend() is not needed.
  virtual bool isWhole() const { return true; }
  /// Time of each moment [s], ascending; at least one. They may be fewer after at() has thrown.
  virtual const std::vector<double>& times() const = 0;
  /// @throws RecordingError when the file has changed, or is damaged there.
  virtual RunSnapshot at(std::size_t moment) = 0;
  /// Paths of the robots through all moments.
  virtual const RunPaths& paths() const = 0;
  /// Events of the robots in all moments; empty for recordings of other programs.
  virtual const RunEvents& events() const = 0;
  /// Reason for an early end, and what was left out; empty for a complete file.
  virtual const std::string& readError() const = 0;
  virtual bool isOfOtherProgram() const = 0;
  /// RawlogReader::isDamaged(), of the whole file.
  virtual bool isDamaged() const = 0;
};

/// Opens a recording made by RoboSim or by another program. A large one of RoboSim with an index is not read
/// (openIndexedRecording()), others in full.
/// @param pictures of cameras in its moments, if it is of RoboSim
/// @throws ConfigError as RawlogReader does, or when the recording has nothing that can be shown.
std::unique_ptr<RecordedMoments> readMoments(const std::string& file, Pictures pictures = Pictures::leave_out);

/// The same of a recording made by RoboSim, of which those that are read have their first moment only. @return null for
/// one of another program
std::unique_ptr<RecordedMoments> openMoments(const std::string& file, Pictures pictures = Pictures::leave_out);

/// Reads a recording that openMoments() has opened in full, in a thread of its own. The destructor ends it.
class MomentsReading {
 public:
  MomentsReading(const std::string& file, Pictures pictures);
  ~MomentsReading();
  MomentsReading(const MomentsReading&) = delete;
  MomentsReading& operator=(const MomentsReading&) = delete;

  /// Time up to which it has been read [s].
  double reached() const { return reached_s_; }
  bool isDone() const;
  /// Waits for the end. @throws as readMoments()
  std::unique_ptr<RecordedMoments> take() { return result_.get(); }

 private:
  std::atomic<double> reached_s_{0};
  std::atomic<bool> is_cancelled_{false};
  std::future<std::unique_ptr<RecordedMoments>> result_;
};

}  // namespace robosim
