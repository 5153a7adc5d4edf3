#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <mrpt/obs/CObservation.h>

#include "recording/unpacked_file.h"

namespace robosim {

/// What was read of a recording so far.
struct ReadReport {
  std::optional<std::string> error;   ///< where and why it was not read completely
  bool ends_early = false;            ///< reading ended before the end of the file's contents
  bool is_damaged = false;            ///< bytes are wrong; a file that is only cut off is not damaged
  std::uint64_t entries = 0;          ///< objects, or messages
  std::uint64_t skipped_entries = 0;  ///< those that are neither observation nor action nor frame
  /// @name Of a recording of ROS 2 or a log of CARMEN, complete at its end
  ///@{
  std::vector<std::string> unread;       ///< "/points (sensor_msgs/msg/PointCloud2), 12 messages", "NMEAGGA, 3 lines"
  std::vector<std::string> assumptions;  ///< of what the recording does not say, as a sensor's pose
  ///@}
};

/// What is made of an observation beforehand, by the threads that decode it.
using Prepare = std::function<std::shared_ptr<void>(const mrpt::obs::CObservation&)>;

/// The observations of a file, in order. RawlogReader reads them.
class ObservationSource {
 public:
  virtual ~ObservationSource() = default;

  /// The next observation; null at the end. @throws ConfigError for a recording without any that is read
  virtual mrpt::obs::CObservation::Ptr next() = 0;
  /// @name As of RawlogReader
  ///@{
  virtual std::uint64_t position() const = 0;
  virtual void seek(std::uint64_t position) = 0;
  virtual void prepareWith(const Prepare& /*prepare*/) {}
  virtual std::shared_ptr<void> prepared() const { return nullptr; }
  ///@}
  virtual const ReadReport& report() const = 0;
};

/// Of an MRPT rawlog, also in an MCAP file of RoboSim. @param threads as of RawlogReader
/// @throws ConfigError as UnpackedFile does, and for another file
std::unique_ptr<ObservationSource> openRawlog(const std::filesystem::path& file, UnpackedFile::Access access,
                                              int threads = 1);
/// Of a recording of ROS 2 by another program, in the order of time. @throws ConfigError as Bag does
std::unique_ptr<ObservationSource> openRosRecording(const std::filesystem::path& bag);

/// Of a log of CARMEN, as text or compressed with gzip: odometry, scans and true poses in the order of its lines. Wrong
/// lines are left out; the report has the first one with its number. @throws ConfigError as UnpackedFile does
std::unique_ptr<ObservationSource> openCarmenLog(const std::filesystem::path& log, UnpackedFile::Access access);

/// Whether a recording is one of ROS 2 by another program: a folder, a database, or an MCAP file without the rawlog
/// that RoboSim stores in its own.
bool isRosRecording(const std::filesystem::path& recording);

}  // namespace robosim
