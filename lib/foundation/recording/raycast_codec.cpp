#include <bit>
#include <cmath>
#include <memory>
#include <utility>

#include <opencv2/core/mat.hpp>

#include "recording/codecs.h"
#include "recording/exact_observations.h"

namespace robosim {
namespace {

using mrpt::math::CMatrix_u16;
using mrpt::obs::CObservation;
using mrpt::obs::CObservation3DRangeScan;
using mrpt::obs::CObservationImage;

/// Ranges in the units of a scan's rangeImage, which has 16 bits.
constexpr float kRangeSteps = 65000;
/// Layers beside the rangeImage with all bits of the depths and identities, in halves.
constexpr const char *kDepthLayers[] = {"depth_bits_low", "depth_bits_high"},
                     *kIdentityLayers[] = {"identity_low", "identity_high"};

mrpt::img::CImage imageOf(const RawPicture& raw) {
  mrpt::img::CImage image(raw.width_px, raw.height_px, mrpt::img::CH_RGB);
  cv::Mat& pixels = image.asCvMatRef();
  const std::uint8_t* from = raw.rgb.data();
  for (int row = 0; row < pixels.rows; ++row) {
    std::uint8_t* to = pixels.ptr(row);
    for (int column = 0; column < pixels.cols; ++column, to += 3, from += 3) {
      for (const int channel : {0, 1, 2}) to[channel] = from[2 - channel];  // blue first
    }
  }
  return image;
}

bool hasSize(const mrpt::img::CImage& image, const CameraInfo& camera) {
  return !image.isExternallyStored() && !image.isEmpty() && image.isColor() && image.getWidth() == camera.width_px &&
         image.getHeight() == camera.height_px && image.getPixelDepth() == mrpt::img::PixelDepth::D8U;
}

std::vector<std::uint8_t> colorsOf(const mrpt::img::CImage& image) {
  const cv::Mat& pixels = image.asCvMatRef();
  std::vector<std::uint8_t> rgb;
  rgb.reserve(3 * pixels.total());
  for (int row = 0; row < pixels.rows; ++row) {
    const std::uint8_t* from = pixels.ptr(row);
    for (int column = 0; column < pixels.cols; ++column, from += 3) rgb.insert(rgb.end(), {from[2], from[1], from[0]});
  }
  return rgb;
}

RawPicture blankOf(const SensorInfo& sensor) {
  RawPicture raw;
  raw.width_px = sensor.camera.width_px;
  raw.height_px = sensor.camera.height_px;
  raw.range_max_m = static_cast<float>(sensor.range_max_m);
  return raw;
}

bool isOf(const SensorInfo& sensor, bool is_image) {
  const PictureLayers& layers = sensor.camera.layers;
  return sensor.kind == SensorKind::camera && layers.any() && is_image == (!layers.depth && !layers.identity);
}

/// Colours only: CObservationImage.
class RaycastImageCodec : public CodecOf<ExactImageObservation, Image> {
 public:
  bool encodes(const SensorInfo& sensor) const override { return isOf(sensor, true); }
  Measurement measurementFrom(const CObservation& observation, const SensorInfo& sensor, float,
                              const std::filesystem::path&) const override {
    const auto* const seen = dynamic_cast<const CObservationImage*>(&observation);
    if (!seen) refuse(observation, sensor, "the class should be mrpt::obs::CObservationImage");
    if (!hasSize(seen->image, sensor.camera)) refuse(observation, sensor, "it has no picture of the camera's size");
    RawPicture raw = blankOf(sensor);
    raw.rgb = colorsOf(seen->image);
    return Image{"", std::make_shared<RawPicture>(std::move(raw))};
  }

 private:
  void init(ExactImageObservation& picture, const SensorInfo& sensor) const override { setCamera(picture, sensor); }
  void set(ExactImageObservation& picture, const SensorInfo&, const Image& image, float) const override {
    picture.image = imageOf(*image.raw);
  }
  Image get(const ExactImageObservation&, const SensorInfo&, float) const override { return {}; }
};

/// Two layers with the lower and higher halves of numbers.
template <typename T>
void addHalves(CObservation3DRangeScan& scan, const char* const (&names)[2], const std::vector<T>& numbers,
               const RawPicture& raw) {
  for (const int half : {0, 1}) {
    CMatrix_u16& layer = scan.rangeImageOtherLayers[names[half]];
    layer.resize(raw.height_px, raw.width_px);
    auto* to = layer.data();
    for (const T number : numbers) {
      *to++ = static_cast<std::uint16_t>(std::bit_cast<std::uint32_t>(number) >> (16 * half));
    }
  }
}

/// MRPT 2.5.8 reads these layers with rows and columns exchanged, but their numbers in the same order.
/// @returns whether the layers exist, with a number for each pixel
template <typename T>
bool readHalves(const CObservation3DRangeScan& scan, const char* const (&names)[2], std::vector<T>& numbers,
                const RawPicture& raw) {
  const auto low = scan.rangeImageOtherLayers.find(names[0]), high = scan.rangeImageOtherLayers.find(names[1]);
  const auto has_size = [&](const CMatrix_u16& layer) {
    return layer.rows() >= 0 && layer.cols() >= 0 &&
           static_cast<std::size_t>(layer.rows()) * static_cast<std::size_t>(layer.cols()) == raw.pixels();
  };
  const auto end = scan.rangeImageOtherLayers.end();
  if (low == end || high == end || !has_size(low->second) || !has_size(high->second)) return false;
  for (std::size_t i = 0; i < raw.pixels(); ++i) {
    numbers.push_back(
        std::bit_cast<T>(std::uint32_t{low->second.data()[i]} | std::uint32_t{high->second.data()[i]} << 16));
  }
  return true;
}

/// Depths or identities: CObservation3DRangeScan, whose rangeImage has the depths to within range_max_m / 130000, and 0
/// for nothing within range.
class RaycastDepthCodec : public CodecOf<ExactDepthObservation, Image> {
 public:
  bool encodes(const SensorInfo& sensor) const override { return isOf(sensor, false); }
  Measurement measurementFrom(const CObservation& observation, const SensorInfo& sensor, float,
                              const std::filesystem::path&) const override {
    const auto* const scan = dynamic_cast<const CObservation3DRangeScan*>(&observation);
    if (!scan) refuse(observation, sensor, "the class should be mrpt::obs::CObservation3DRangeScan");
    const PictureLayers& layers = sensor.camera.layers;
    RawPicture raw = blankOf(sensor);
    const auto fail = [&](const char* what) { refuse(observation, sensor, std::string("it has no ") + what); };
    if (layers.rgb && !(scan->hasIntensityImage && hasSize(scan->intensityImage, sensor.camera))) {
      fail("picture of the camera's size");
    }
    if (layers.rgb) raw.rgb = colorsOf(scan->intensityImage);
    if (layers.depth && !readHalves(*scan, kDepthLayers, raw.depth_m, raw)) fail("depths of the camera's size");
    for (const float depth : raw.depth_m) {
      if (!(depth >= 0 && depth <= raw.range_max_m)) fail("possible depths");
    }
    if (layers.identity && !readHalves(*scan, kIdentityLayers, raw.identity, raw)) fail("identities of bodies");
    return Image{"", std::make_shared<RawPicture>(std::move(raw))};
  }

 private:
  void init(ExactDepthObservation& scan, const SensorInfo& sensor) const override {
    setCamera(scan, sensor);
    scan.maxRange = static_cast<float>(sensor.range_max_m);
    scan.rangeUnits = scan.maxRange / kRangeSteps;
    scan.range_is_depth = true;
    scan.intensityImageChannel = CObservation3DRangeScan::CH_VISIBLE;
  }
  void set(ExactDepthObservation& scan, const SensorInfo&, const Image& image, float) const override {
    const RawPicture& raw = *image.raw;
    scan.hasIntensityImage = !raw.rgb.empty();
    if (scan.hasIntensityImage) scan.intensityImage = imageOf(raw);
    scan.hasRangeImage = true;  // without it, MRPT stores no layers
    scan.rangeImage_setSize(static_cast<int>(raw.height_px), static_cast<int>(raw.width_px));
    auto* to = scan.rangeImage.data();
    std::fill_n(to, raw.pixels(), std::uint16_t{0});
    for (const float depth : raw.depth_m) *to++ = static_cast<std::uint16_t>(std::lround(depth / scan.rangeUnits));
    if (!raw.depth_m.empty()) addHalves(scan, kDepthLayers, raw.depth_m, raw);
    if (!raw.identity.empty()) addHalves(scan, kIdentityLayers, raw.identity, raw);
  }
  Image get(const ExactDepthObservation&, const SensorInfo&, float) const override { return {}; }
};

}  // namespace

const Codec& raycastImageCodec() { return theCodec<RaycastImageCodec>(); }
const Codec& raycastDepthCodec() { return theCodec<RaycastDepthCodec>(); }

}  // namespace robosim
