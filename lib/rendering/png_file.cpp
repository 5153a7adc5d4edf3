#include "rendering/png_file.h"

#include <string_view>
#include <vector>

#include <opencv2/imgcodecs.hpp>

#include "base/error_list.h"
#include "base/whole_file.h"

namespace robosim {
namespace {

void checkName(const std::filesystem::path& file) {
  if (file.extension() != ".png") {
    throw ConfigError(file.string() + ": a picture is a PNG file; give it a name that ends in .png");
  }
}

}  // namespace

void checkPngFile(const std::filesystem::path& file) {
  checkName(file);
  checkWritable(file);
}

void writePngFile(const std::filesystem::path& file, const cv::Mat& picture) {
  checkName(file);
  WholeFile whole(file);
  std::vector<unsigned char> bytes;
  cv::imencode(".png", picture, bytes, {cv::IMWRITE_PNG_COMPRESSION, 9});
  whole.write({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  whole.commit();
}

}  // namespace robosim
