#include <cstring>

#include <isa-l/crc.h>
#include <opencv2/imgcodecs.hpp>

#include "base/error_list.h"
#include "world/maps/picture.h"

namespace robosim {
namespace {

constexpr char kSignature[] = "\x89PNG\r\n\x1a\n";
constexpr std::size_t kSignatureBytes = 8;

std::uint32_t bigEndian(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
  return value;
}

/// Validates the structure of a PNG file (PNG specification, 2nd edition, § 5): its size, and that every chunk is
/// present and intact. The decoder's errors would not name a position.
void check(const std::string& bytes, const std::string& name) {
  constexpr std::size_t kAroundData = 12;  // length, type, and check sum
  bool is_first = true;
  for (std::size_t at = kSignatureBytes;;) {
    const std::string where = "the part at byte " + std::to_string(at);
    if (bytes.size() < at + kAroundData) throw ConfigError(name + ": is cut off: " + where + " is missing");
    const std::size_t length = bigEndian(bytes, at);
    if (bytes.size() - at - kAroundData < length) throw ConfigError(name + ": is cut off within " + where);
    const auto* checked = reinterpret_cast<const unsigned char*>(bytes.data()) + at + 4;
    if (crc32_gzip_refl(0, checked, length + 4) != bigEndian(bytes, at + 8 + length)) {
      throw ConfigError(name + ": is damaged: " + where + " has a wrong check sum");
    }
    const std::string type = bytes.substr(at + 4, 4);
    if (is_first && (type != "IHDR" || length != 13)) throw ConfigError(name + ": is damaged: it has no header");
    if (is_first) checkPictureSize(bigEndian(bytes, at + 8), bigEndian(bytes, at + 12), name);
    if (type == "IEND") return;
    is_first = false;
    at += kAroundData + length;
  }
}

template <typename Value>
void addUp(const cv::Mat& image, Picture& picture, bool has_alpha, std::uint32_t first) {
  const int stored = image.channels();
  picture.sums.reserve(image.total());
  if (has_alpha) picture.is_transparent.reserve(image.total());
  for (int row = 0; row < image.rows; ++row) {
    const auto* value = image.ptr<Value>(row);
    for (int column = 0; column < image.cols; ++column, value += stored) {
      std::uint32_t sum = 0;
      for (std::uint32_t i = first; i < first + picture.channels; ++i) sum += value[i];
      picture.sums.push_back(sum);
      if (has_alpha) picture.is_transparent.push_back(value[stored - 1] < picture.white);
    }
  }
}

}  // namespace

bool isPng(const std::string& bytes) { return bytes.compare(0, kSignatureBytes, kSignature) == 0; }

Picture readPng(const std::string& bytes, const std::string& name, Picture::Alpha alpha) {
  check(bytes, name);
  cv::Mat image;
  try {
    const cv::Mat encoded(1, static_cast<int>(bytes.size()), CV_8U, const_cast<char*>(bytes.data()));
    image = cv::imdecode(encoded, cv::IMREAD_UNCHANGED);
  } catch (const cv::Exception&) {
    image.release();
  }
  if (image.empty()) throw ConfigError(name + ": is a PNG file whose picture cannot be decoded; save it again");
  Picture picture;
  picture.columns = static_cast<std::uint32_t>(image.cols);
  picture.rows = static_cast<std::uint32_t>(image.rows);
  const auto stored = static_cast<std::uint32_t>(image.channels());
  picture.channels = stored == 4 && alpha != Picture::Alpha::counts ? 3 : stored;
  const bool is_only_red = alpha == Picture::Alpha::only_red;
  const std::uint32_t first = is_only_red && stored >= 3 ? 2 : 0;  // the order is blue, green, red
  if (is_only_red) picture.channels = 1;
  const bool marks_unknown = stored == 4 && alpha == Picture::Alpha::marks_unknown;
  if (image.depth() == CV_16U) {
    picture.white = 65535;
    addUp<std::uint16_t>(image, picture, marks_unknown, first);
  } else {
    addUp<std::uint8_t>(image, picture, marks_unknown, first);
  }
  return picture;
}

}  // namespace robosim
