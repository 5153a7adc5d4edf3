#include "rendering/png_file.h"

#include <algorithm>
#include <cctype>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <opencv2/imgcodecs.hpp>

#include "base/atomic_file.h"
#include "base/error_list.h"

namespace robosim {
namespace {

void checkName(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
  if (ending != ".png") {
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
  AtomicFile whole(file);
  std::vector<unsigned char> bytes;
  if (!cv::imencode(".png", picture, bytes, {cv::IMWRITE_PNG_COMPRESSION, 9})) {
    throw std::runtime_error(file.string() + ": the picture could not be compressed; ask for a smaller one");
  }
  whole.write({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  whole.commit();
}

}  // namespace robosim
