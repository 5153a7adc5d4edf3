#pragma once
#include <cstdint>
#include <filesystem>

#include <opencv2/core/mat.hpp>
#include <opencv2/videoio.hpp>

#include "base/interrupt.h"

namespace robosim {

/// Writer of an MP4 video. Until commit(), the file is named "<name>.part.mp4"; destruction without commit() removes
/// it. OpenCV and FFmpeg do not report write errors of frames or of the final index, so commit() verifies the file on
/// disk.
class VideoFile {
 public:
  /// @throws ConfigError when the file cannot be created.
  VideoFile(const std::filesystem::path& file, int width_px, int height_px, double fps);
  ~VideoFile();
  VideoFile(const VideoFile&) = delete;
  VideoFile& operator=(const VideoFile&) = delete;

  /// Adds a frame, BGR. Drops the last row or column of an odd size, because the codec requires even sizes.
  void add(const cv::Mat& picture);
  /// Completes the file and renames it.
  /// @throws std::runtime_error when the file is incomplete: the disk is full, or fails.
  void commit();

 private:
  void checkWhole() const;

  std::filesystem::path file_, part_;
  PartialFile partial_;  ///< at part_
  cv::VideoWriter writer_;
  std::uint64_t frames_ = 0;
};

}  // namespace robosim
