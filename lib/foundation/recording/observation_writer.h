#pragma once
#include <filesystem>

#include <mrpt/core/Clock.h>
#include <mrpt/obs/CObservation.h>

#include "recording/byte_archive.h"
#include "recording/gzip_file.h"

namespace robosim {

/// Writes observations that were read from a rawlog to a new one, without changes, except that images are embedded as
/// JPEG: an external file unchanged, an embedded image compressed again. The file appears when it is complete. Its
/// index has only members: a view reads it as a whole.
class ObservationWriter {
 public:
  /// @param pictures the folder of external images of the rawlog that the observations come from
  /// @throws ConfigError when the file cannot be created, or another program writes it.
  ObservationWriter(const std::filesystem::path& file, std::filesystem::path pictures);

  /// @throws RecordingError when an image or the file fails (extractJpeg(), GzipFile::write()).
  void write(const mrpt::obs::CObservation&);
  /// @throws RecordingError as GzipFile::commit().
  void commit();

 private:
  void flush();

  mrpt::Clock::time_point last_time_;  ///< timestamp of the last observation
  std::filesystem::path pictures_;
  ByteArchive buffer_;
  GzipFile file_;
};

}  // namespace robosim
