#include "rendering/png_file.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <string>
#include <vector>

#include <opencv2/imgcodecs.hpp>

#include "base/error_list.h"

namespace robosim {
namespace {

namespace fs = std::filesystem;

fs::path partOf(const fs::path& file) { return file.string() + ".part"; }

std::ofstream openPart(const fs::path& file) {
  if (file.extension() != ".png") {
    throw ConfigError(file.string() + ": a picture is a PNG file; give it a name that ends in .png");
  }
  if (fs::is_directory(file)) throw ConfigError(file.string() + ": is a folder; name a file in it");
  errno = 0;
  std::ofstream out(partOf(file), std::ios::binary);
  if (!out) {
    throw ConfigError(file.string() + ": cannot be written (" + std::strerror(errno) +
                      "); check that its folder exists and may be written to");
  }
  return out;
}

}  // namespace

void checkPngFile(const fs::path& file) {
  openPart(file).close();
  fs::remove(partOf(file));
}

void writePngFile(const fs::path& file, const cv::Mat& picture) {
  std::vector<unsigned char> bytes;
  cv::imencode(".png", picture, bytes, {cv::IMWRITE_PNG_COMPRESSION, 9});
  std::ofstream out = openPart(file);
  out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  out.close();
  std::error_code error;
  if (out) fs::rename(partOf(file), file, error);
  if (!out || error) {
    const std::string why = error ? error.message() : std::strerror(errno);
    fs::remove(partOf(file), error);
    throw ConfigError(file.string() + ": cannot be written (" + why + "); choose another place");
  }
}

}  // namespace robosim
