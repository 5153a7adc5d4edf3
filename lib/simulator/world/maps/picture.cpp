#include "world/maps/picture.h"

#include "base/error_list.h"
#include "base/jpeg_file.h"

namespace robosim {
namespace {

bool isJpeg(const std::string& bytes) { return bytes.starts_with("\xff\xd8\xff"); }

Picture readJpeg(const std::string& bytes, const std::string& name, bool is_only_red) {
  if (const JpegSize size = jpegSize(bytes); size.columns > 0) checkPictureSize(size.columns, size.rows, name);
  std::string fault;
  const JpegPicture jpeg = decodeJpeg(bytes, fault);
  if (!fault.empty()) throw ConfigError(name + ": is a damaged JPEG picture: " + fault);
  Picture picture;
  picture.columns = jpeg.columns;
  picture.rows = jpeg.rows;
  picture.channels = is_only_red ? 1 : jpeg.channels;
  picture.sums.reserve(jpeg.values.size() / jpeg.channels);
  for (std::size_t i = 0; i < jpeg.values.size(); i += jpeg.channels) {
    std::uint32_t sum = 0;
    for (std::uint32_t channel = 0; channel < picture.channels; ++channel) sum += jpeg.values[i + channel];
    picture.sums.push_back(sum);
  }
  return picture;
}

}  // namespace

Picture readPicture(const std::string& bytes, const std::string& name, Picture::Alpha alpha) {
  if (isPng(bytes)) return readPng(bytes, name, alpha);
  if (isPortableMap(bytes)) return readPortableMap(bytes, name, alpha);
  if (isBmp(bytes)) return readBmp(bytes, name, alpha);
  if (isJpeg(bytes)) return readJpeg(bytes, name, alpha == Picture::Alpha::only_red);
  throw ConfigError(name + ": is no PNG, PGM, PPM, PBM, BMP or JPEG picture; save it as one of these");
}

void checkPictureSize(std::uint64_t columns, std::uint64_t rows, const std::string& name) {
  const std::string size = std::to_string(columns) + " × " + std::to_string(rows) + " pixels";
  if (columns == 0 || rows == 0) throw ConfigError(name + ": its header declares " + size + ", which is empty");
  if (columns > kMaxMapCells || rows > kMaxMapCells || columns * rows > kMaxMapCells) {
    throw ConfigError(name + ": its header declares " + size + "; a map may have " + std::to_string(kMaxMapCells) +
                      " cells at most, so make it smaller");
  }
}

OccupancyGrid gridOf(const Picture& picture, const PixelInterpretation& meaning) {
  const auto occupancy_at = [&](std::uint32_t sum) {
    const double value = static_cast<double>(sum) / picture.channels;
    if (meaning.is_percent) return value > 100 ? Occupancy::unknown : meaning.thresholds.of(value / 100);
    return meaning.thresholds.of((meaning.negate ? value : picture.white - value) / picture.white);
  };
  std::vector<Occupancy> occupancy_of_sum(std::size_t{picture.white} * picture.channels + 1);
  for (std::uint32_t sum = 0; sum < occupancy_of_sum.size(); ++sum) occupancy_of_sum[sum] = occupancy_at(sum);

  OccupancyGrid grid;
  grid.columns = picture.columns;
  grid.rows = picture.rows;
  grid.cells.resize(picture.sums.size());
  for (std::uint32_t row = 0; row < grid.rows; ++row) {
    const std::uint32_t* from = picture.sums.data() + std::size_t{picture.rows - 1 - row} * picture.columns;
    Occupancy* to = grid.cells.data() + std::size_t{row} * grid.columns;
    for (std::uint32_t column = 0; column < grid.columns; ++column) to[column] = occupancy_of_sum[from[column]];
    if (picture.is_transparent.empty()) continue;
    const std::size_t first = std::size_t{picture.rows - 1 - row} * picture.columns;
    for (std::uint32_t column = 0; column < grid.columns; ++column) {
      if (!picture.is_transparent[first + column]) continue;
      to[column] = Occupancy::unknown;
      ++grid.transparent;
    }
  }
  return grid;
}

}  // namespace robosim
