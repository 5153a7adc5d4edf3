#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>

#include <opencv2/core/mat.hpp>

#include "base/atomic_file.h"

namespace robosim {

/// Whether the name of a file ends in .mp4, .webm or .webp, in upper or lower case.
bool isVideo(const std::filesystem::path& file);

/// Writer of a video by FFmpeg's libraries: MP4 with H.264 (avc1) and its index in front of the pictures, so that
/// players start before the file is complete; WebM with VP9; or an animated WebP picture, which repeats. Pixels of MP4
/// and WebM are yuv420p in BT.709, with a key frame at least every two seconds for seeking. Equal pictures give equal
/// bytes with the same version of the libraries. The file appears under its name only on commit() (AtomicFile).
class VideoFile {
 public:
  /// @param file .mp4, .webm or .webp
  /// @param fps frames per second
  /// @throws ConfigError when the file cannot be created, or its encoder is not installed.
  /// @throws std::runtime_error when the encoder refuses the size or the frame rate.
  VideoFile(const std::filesystem::path& file, int width_px, int height_px, double fps);
  ~VideoFile();
  VideoFile(const VideoFile&) = delete;
  VideoFile& operator=(const VideoFile&) = delete;

  /// Adds a frame: BGR, 8 bits, of the given size. Drops the last row or column of an odd size, because the codecs
  /// require even sizes.
  /// @throws std::runtime_error when the disk is full, or fails.
  void add(const cv::Mat& picture);
  /// Completes the file, waits until it is on the disk, and renames it.
  /// @throws std::runtime_error as add() does.
  void commit();

 private:
  struct Encoder;

  AtomicFile file_;
  std::unique_ptr<Encoder> encoder_;
};

}  // namespace robosim
