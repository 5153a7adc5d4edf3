#include "viewing/video_file.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <string>
#include <system_error>

#include <fcntl.h>
#include <opencv2/core/utils/logger.hpp>
#include <unistd.h>

#include "base/error_list.h"

namespace robosim {
namespace {

namespace fs = std::filesystem;

/// Flushes a file to disk. @return 0, or errno
int sync(const fs::path& file) {
  const int descriptor = open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return errno;
  const int error = fsync(descriptor) == 0 ? 0 : errno;
  close(descriptor);
  return error;
}

/// Whether an MP4 file consists of complete boxes (ISO/IEC 14496-12, 4.2), including its index, "moov".
bool hasWholeBoxes(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  const std::uint64_t size = fs::file_size(file);
  bool has_index = false;
  std::uint64_t at = 0;
  while (at < size) {
    const auto number = [&in](int bytes) {
      std::uint64_t value = 0;
      for (int i = 0; i < bytes; ++i) value = value << 8 | static_cast<std::uint64_t>(in.get() & 0xff);
      return value;
    };
    in.seekg(static_cast<std::streamoff>(at));
    std::uint64_t box_bytes = number(4), header_bytes = 8;
    char type[4] = {};
    in.read(type, sizeof type);
    if (box_bytes == 1) {
      box_bytes = number(8);
      header_bytes = 16;
    }
    if (!in || box_bytes < header_bytes || box_bytes > size - at) return false;
    has_index = has_index || std::memcmp(type, "moov", sizeof type) == 0;
    at += box_bytes;
  }
  return has_index;
}

}  // namespace

VideoFile::VideoFile(const fs::path& file, int width_px, int height_px, double fps)
    : file_(file), part_(file.string() + ".part.mp4"), partial_(part_.string()) {
  // Errors are reported below.
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
  writer_.open(part_.string(), cv::CAP_FFMPEG, cv::VideoWriter::fourcc('m', 'p', '4', 'v'), fps,
               {width_px & ~1, height_px & ~1});
  if (!writer_.isOpened()) {
    throw ConfigError(part_.string() +
                      ": no video can be written there; check that the folder is writable and the package "
                      "libopencv-videoio is installed with FFmpeg");
  }
}

VideoFile::~VideoFile() {
  writer_.release();
  std::error_code ignored;
  fs::remove(part_, ignored);
}

void VideoFile::add(const cv::Mat& picture) {
  writer_.write(picture(cv::Rect(0, 0, picture.cols & ~1, picture.rows & ~1)));
  ++frames_;
}

void VideoFile::commit() {
  writer_.release();
  checkWhole();
  std::error_code error;
  fs::rename(part_, file_, error);
  if (error) {
    throw std::runtime_error(file_.string() + ": cannot be written (" + error.message() + "); choose another place");
  }
}

void VideoFile::checkWhole() const {
  const int failure = sync(part_);
  const auto fail = [&](const std::string& why) {
    throw std::runtime_error(file_.string() + ": the video could not be written (" + why +
                             "); free disk space, or choose another place");
  };
  if (failure != 0) fail(std::strerror(failure));
  if (!hasWholeBoxes(part_)) fail("the file is incomplete; the disk may be full");
  cv::VideoCapture capture(part_.string(), cv::CAP_FFMPEG);
  const double frames = capture.isOpened() ? capture.get(cv::CAP_PROP_FRAME_COUNT) : 0;
  if (frames != static_cast<double>(frames_)) {
    fail("it has " + std::to_string(static_cast<std::uint64_t>(frames)) + " of " + std::to_string(frames_) +
         " frames; the disk may be full");
  }
}

}  // namespace robosim
