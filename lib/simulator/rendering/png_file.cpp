#include "rendering/png_file.h"

#include <stdexcept>
#include <string>
#include <vector>

#include <mrpt/core/format.h>
#include <opencv2/imgcodecs.hpp>

#include "base/atomic_file.h"
#include "base/error_list.h"
#include "rendering/picture_format.h"

namespace robosim {
namespace {

void checkName(const std::filesystem::path& file) {
  if (recognizePictureFormat(file) == PictureFormat::png) return;
  throw ConfigError(file.string() + ": a picture is a PNG file; give it a name that ends in .png");
}

}  // namespace

void checkPngFile(const std::filesystem::path& file) {
  checkName(file);
  checkWritable(file);
}

std::string encodePng(const cv::Mat& picture) {
  std::vector<unsigned char> bytes;
  if (!cv::imencode(".png", picture, bytes, {cv::IMWRITE_PNG_COMPRESSION, 9})) {
    throw std::runtime_error(mrpt::format(
        "the picture of %d × %d pixels could not be compressed; ask for a smaller one", picture.cols, picture.rows));
  }
  return {bytes.begin(), bytes.end()};
}

void writePngFile(const std::filesystem::path& file, const cv::Mat& picture) {
  checkName(file);
  AtomicFile whole(file);
  whole.write(encodePng(picture));
  whole.commit();
}

}  // namespace robosim
