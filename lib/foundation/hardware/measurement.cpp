#include "hardware/measurement.h"

#include <algorithm>
#include <cstdio>
#include <limits>
#include <stdexcept>
#include <utility>

#include "hardware/measurement_fields.h"

namespace robosim {
namespace {

/// Whether sensors of a kind measure the variant's alternative `index`.
template <std::size_t index>
constexpr bool measures(SensorKind kind) {
  const auto& kinds = Description<std::variant_alternative_t<index, Measurement>>::kinds;
  return std::find(kinds.begin(), kinds.end(), kind) != kinds.end();
}

template <std::size_t... index>
constexpr bool eachKindHasOneMeasurement(std::index_sequence<index...>) {
  for (std::size_t kind = 0; kind < kSensorKindNames.size(); ++kind) {
    if ((measures<index>(static_cast<SensorKind>(kind)) + ...) != 1) return false;
  }
  return true;
}
static_assert(eachKindHasOneMeasurement(std::make_index_sequence<std::variant_size_v<Measurement>>()),
              "each SensorKind is in the `kinds` of exactly one Description");

template <std::size_t... index>
Measurement blankOf(const SensorInfo& sensor, std::index_sequence<index...>) {
  Measurement blank;
  ((measures<index>(sensor.kind) &&
    (blank = Description<std::variant_alternative_t<index, Measurement>>::blank(sensor), true)) ||
   ...);
  return blank;
}

std::string textOf(double number, const Unit& unit) {
  char text[64];
  std::snprintf(text, sizeof text, "%.10g%s%s", number, *unit.symbol ? " " : "", unit.symbol);
  return text;
}

}  // namespace

Measurement blankMeasurement(const SensorInfo& sensor) {
  return blankOf(sensor, std::make_index_sequence<std::variant_size_v<Measurement>>());
}

std::string faultOf(const char* name, const Unit& unit, double min, double max, double value) {
  const bool is_bounded = max < std::numeric_limits<double>::max();
  return std::string("a ") + name + " of " + textOf(value, unit) +
         (is_bounded ? "; it must lie in [" + textOf(min, kNoUnit) + ", " + textOf(max, unit) + "]"
                     : "; it must be a finite number");
}

std::string Description<Image>::fileFaultOf(const std::string& jpeg) {
  if (jpeg.size() > kPictureBytesMax) {
    return "a picture of " + std::to_string(jpeg.size()) + " bytes; the most is " + std::to_string(kPictureBytesMax);
  }
  const bool is_valid = jpeg.empty() || (jpeg.starts_with("\xFF\xD8") && jpeg.ends_with("\xFF\xD9"));
  return is_valid ? "" : "a picture that is no JPEG file";
}

void Description<Image>::setFile(Image& image, std::string file) {
  if (RawPicture::isIn(file)) {
    image = {"", std::make_shared<RawPicture>(RawPicture::fromBytes(file))};
    return;
  }
  if (const std::string fault = fileFaultOf(file); !fault.empty()) throw std::invalid_argument(fault);
  image = {std::move(file)};
}

const char* pictureFaultOf(std::span<const Measurement> measurements, std::span<const SensorInfo> sensors) {
  for (std::size_t i = 0; i < measurements.size(); ++i) {
    const auto* image = std::get_if<Image>(&measurements[i]);
    if (!image || image->isEmpty()) continue;
    const CameraInfo& camera = sensors[i].camera;
    if (camera.isRaycast() != (image->raw != nullptr)) return "a picture of another model of camera";
    if (!image->raw) continue;
    const RawPicture& raw = *image->raw;
    if (raw.width_px != camera.width_px || raw.height_px != camera.height_px || raw.layers() != camera.layers ||
        raw.range_max_m != static_cast<float>(sensors[i].range_max_m)) {
      return "a picture of another size, range or other layers than its camera's";
    }
  }
  return nullptr;
}

const char* Description<Blobs>::faultOf(const Blob& blob) {
  const auto is_inside = [](std::uint32_t from, std::uint32_t size, float middle) {
    return from <= kPictureSideMax_px && size <= kPictureSideMax_px - from && middle >= static_cast<float>(from) &&
           middle <= static_cast<float>(from + size);
  };
  const std::uint64_t most = std::uint64_t{blob.width_px} * blob.height_px;
  const bool is_valid = is_inside(blob.left_px, blob.width_px, blob.x_px) &&
                        is_inside(blob.top_px, blob.height_px, blob.y_px) && blob.pixels <= most;
  return is_valid ? nullptr : "a blob outside the image";
}

}  // namespace robosim
