#include "rendering/picture_format.h"

#include <algorithm>
#include <cctype>
#include <string>

#include "base/error_list.h"

namespace robosim {

std::optional<PictureFormat> recognizePictureFormat(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
  if (ending == ".png") return PictureFormat::png;
  if (ending == ".svg") return PictureFormat::svg;
  if (ending == ".pdf") return PictureFormat::pdf;
  return std::nullopt;
}

PictureFormat requirePictureFormat(const std::filesystem::path& file) {
  if (const auto format = recognizePictureFormat(file)) return *format;
  throw ConfigError(file.string() +
                    ": a picture is a PNG, SVG or PDF file; give it a name that ends in .png, .svg or .pdf");
}

}  // namespace robosim
