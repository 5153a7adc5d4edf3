#pragma once
#include <mutex>

#include <mrpt/img/CImage.h>

namespace robosim {

/// Sets MRPT's global switch for the compression of serialised pictures while it exists; one thread at a time.
class PictureCompression {
 public:
  explicit PictureCompression(bool is_on) : lock_(mutex()), was_off_(mrpt::img::CImage::DISABLE_JPEG_COMPRESSION()) {
    mrpt::img::CImage::DISABLE_JPEG_COMPRESSION(!is_on);
  }
  ~PictureCompression() { mrpt::img::CImage::DISABLE_JPEG_COMPRESSION(was_off_); }
  PictureCompression(const PictureCompression&) = delete;
  PictureCompression& operator=(const PictureCompression&) = delete;

 private:
  static std::mutex& mutex() {
    static std::mutex all;
    return all;
  }

  std::lock_guard<std::mutex> lock_;
  bool was_off_;
};

}  // namespace robosim
