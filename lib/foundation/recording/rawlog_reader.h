#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <mrpt/obs/CObservation.h>

#include "base/label.h"
#include "recording/unpacked_file.h"

namespace robosim {

/// Number of threads with which recordings are read, unless another is given: as many as the process has cores, at
/// most 16.
int threadsForReading();

/// Reads the observations of a recording, by RoboSim or other programs, in order: of an MRPT rawlog, of the rawlog in
/// an MCAP file of RoboSim, of a recording of ROS 2 (an MCAP file, a .db3 or a folder of rosbag2: doc/ros2.md),
/// whose observations are in the order of time, with labels and poses of sensors as of RoboSim, or of a log of CARMEN.
/// Sensory frames are split into observations; odometry increments of actions are accumulated and returned as
/// CObservationOdometry with the label kFromActions. Other objects are skipped and counted.
///
/// A truncated or damaged file is read up to the damage, which readError() describes. A damaged picture alone is left
/// out, and the entries after it are read.
class RawlogReader {
 public:
  using Access = UnpackedFile::Access;

  /// @param access random: required for seek(). Of a rawlog with an index (MemberIndex), it may then also be called
  /// with
  ///        the positions of members that were not read
  /// @param threads that decode a rawlog of gzip members, if access is sequential; the observations are the same
  /// @throws ConfigError when the file does not exist, cannot be read, or does not begin with a rawlog's header. Of a
  /// recording of ROS 2, next() also throws it, when there is nothing that is read
  explicit RawlogReader(const std::filesystem::path& file, Access access = Access::sequential,
                        int threads = threadsForReading());
  ~RawlogReader();
  RawlogReader(const RawlogReader&) = delete;
  RawlogReader& operator=(const RawlogReader&) = delete;

  /// Whether this is no rawlog, but a recording in the format of other programs, whose timestamps are times: of ROS 2,
  /// which next() reads completely before the first observation, or of CARMEN.
  bool isForeign() const;
  /// The folder of external images beside the file: "<stem>_Images".
  const std::filesystem::path& pictureFolder() const;

  /// The next observation, in the file's order; null at the end.
  mrpt::obs::CObservation::Ptr next();

  /// Sets what is made of each observation beforehand, by the threads that decode it: those that follow, at the
  /// earliest from the second member of the file on. It is called in any order and by several threads at a time.
  void prepareWith(const std::function<std::shared_ptr<void>(const mrpt::obs::CObservation&)>& prepare);
  /// What was made of the last observation; null for nothing.
  std::shared_ptr<void> prepared() const;

  /// Position of the object that contained the last observation; for seek().
  std::uint64_t position() const;
  /// Continues at an object that was read before: next() returns its first observation. Odometry from actions is
  /// invalid afterwards, because its accumulation is not reset; entries() and skippedEntries() keep counting.
  void seek(std::uint64_t position);

  /// Description of what was not read so far: where and why the file ends early, and damaged pictures; nullopt for a
  /// complete file. seek() resets it.
  const std::optional<std::string>& readError() const;
  /// Whether reading ended before the end of the file's contents.
  bool endsEarly() const;
  /// Whether bytes read so far are wrong. A file that is only cut off, as by a killed program, is not damaged.
  bool isDamaged() const;
  /// Number of objects read so far.
  std::uint64_t entries() const;
  /// Number of objects that are neither observation nor action nor frame.
  std::uint64_t skippedEntries() const;
  /// @name ReadReport, of a foreign recording
  ///@{
  const std::vector<std::string>& unread() const;
  const std::vector<std::string>& assumptions() const;
  ///@}

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Label of the odometry that is accumulated from actions.
inline constexpr const char* kFromActions = "odometry";

}  // namespace robosim
