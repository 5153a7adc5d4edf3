#include "hardware/raw_picture.h"

#include <cstdint>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "base/jpeg_file.h"
#include "hardware/measurement_fields.h"
#include "hardware/picture_file.h"

namespace robosim {
namespace {

RawPicture twoPixels(const PictureLayers& layers) {
  RawPicture picture{2, 1, 4, {}, {}, {}};
  if (layers.rgb) picture.rgb = {200, 100, 50, 0, 0, 255};
  if (layers.depth) picture.depth_m = {1, 0};
  if (layers.identity) picture.identity = {7, RawPicture::kSky};
  return picture;
}

std::string faultOf(const std::string& bytes) {
  try {
    RawPicture::fromBytes(bytes);
  } catch (const std::invalid_argument& fault) {
    return fault.what();
  }
  return "none";
}

TEST(RawPicture, IsReadFromItsBytes) {
  for (int bits = 1; bits < 8; ++bits) {
    const RawPicture picture = twoPixels({(bits & 1) != 0, (bits & 2) != 0, (bits & 4) != 0});
    EXPECT_EQ(RawPicture::fromBytes(picture.toBytes()), picture);
  }
}

TEST(RawPicture, RefusesBytesThatAreNone) {
  const std::string bytes = twoPixels({true, true, true}).toBytes();
  for (std::size_t size = 0; size < bytes.size(); ++size) EXPECT_NE(faultOf(bytes.substr(0, size)), "none") << size;
  EXPECT_EQ(faultOf(bytes + "x"), "a picture of an impossible size");
  RawPicture far = twoPixels({false, true, false});
  far.depth_m[0] = 5;
  EXPECT_EQ(faultOf(far.toBytes()), "a picture with an impossible depth");
  far.depth_m[0] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(faultOf(far.toBytes()), "a picture with an impossible depth");
}

TEST(RawPicture, RefusesSidesThatNoJpegFileHas) {
  RawPicture longest{kPictureSideMax_px, 1, 4, {}, std::vector<float>(kPictureSideMax_px), {}};
  EXPECT_EQ(faultOf(longest.toBytes()), "none");
  constexpr std::uint32_t kTooLong_px = kPictureSideMax_px + 1;
  const std::vector<float> depths(kTooLong_px);
  EXPECT_EQ(faultOf(RawPicture{kTooLong_px, 1, 4, {}, depths, {}}.toBytes()), "a picture of an impossible size");
  EXPECT_EQ(faultOf(RawPicture{1, kTooLong_px, 4, {}, depths, {}}.toBytes()), "a picture of an impossible size");
  longest.range_max_m = std::numeric_limits<float>::infinity();
  EXPECT_EQ(faultOf(longest.toBytes()), "a picture of an impossible size");
}

TEST(RawPicture, IsViewedByItsColoursElseItsDepthsElseItsBodies) {
  using Bytes = std::vector<std::uint8_t>;
  EXPECT_EQ(twoPixels({true, true, true}).viewedColors(), (Bytes{200, 100, 50, 0, 0, 255}));
  // 1 of 4 m is three quarters of white; nothing within range is black.
  EXPECT_EQ(twoPixels({false, true, true}).viewedColors(), (Bytes{191, 191, 191, 0, 0, 0}));
  const Bytes bodies = twoPixels({false, false, true}).viewedColors();
  ASSERT_EQ(bodies.size(), 6u);
  EXPECT_NE(Bytes(bodies.begin(), bodies.begin() + 3), Bytes(bodies.begin() + 3, bodies.end()));
}

TEST(RawPicture, IsAMeasurementThatIsEqualByItsPixels) {
  const Image one{"", std::make_shared<const RawPicture>(twoPixels({true, false, false}))};
  const Image same{"", std::make_shared<const RawPicture>(*one.raw)};
  RawPicture other = *one.raw;
  other.rgb[0] = 1;
  EXPECT_EQ(one, same);
  EXPECT_NE(one, (Image{"", std::make_shared<const RawPicture>(other)}));
  EXPECT_NE(one, Image{});
  EXPECT_TRUE(isPresent(one));
  Image read;
  Description<Image>::setFile(read, Description<Image>::file(one));
  EXPECT_EQ(read, one);
}

TEST(RawPicture, IsOfItsCamera) {
  SensorInfo sensor;
  sensor.kind = SensorKind::camera;
  sensor.range_max_m = 4;
  sensor.camera = {.width_px = 2, .height_px = 1, .layers = {true, false, false}};
  const auto fault_of = [&](const Image& image) {
    const Measurement measurement = image;
    const char* fault = pictureFaultOf({&measurement, 1}, {&sensor, 1});
    return std::string(fault ? fault : "none");
  };
  const auto picture = [](const RawPicture& raw) { return Image{"", std::make_shared<const RawPicture>(raw)}; };
  const RawPicture good = twoPixels(sensor.camera.layers);
  EXPECT_EQ(fault_of(picture(good)), "none");
  EXPECT_EQ(fault_of({}), "none");
  EXPECT_EQ(fault_of({"a file"}), "a picture of another model of camera");
  RawPicture other = good;
  std::swap(other.width_px, other.height_px);
  constexpr const char* kOther = "a picture of another size, range or other layers than its camera's";
  EXPECT_EQ(fault_of(picture(other)), kOther);
  EXPECT_EQ(fault_of(picture(twoPixels({false, true, false}))), kOther);
  other = good;
  other.range_max_m = 5;
  EXPECT_EQ(fault_of(picture(other)), kOther);
  sensor.camera.layers = {};
  EXPECT_EQ(fault_of(picture(good)), "a picture of another model of camera");
  EXPECT_EQ(fault_of({"a file"}), "none");
}

TEST(PictureFile, IsAJpegOfARaycastPicture) {
  RawPicture picture{16, 8, 4, {}, {}, {}};
  for (int i = 0; i < 16 * 8; ++i) picture.rgb.insert(picture.rgb.end(), {200, 100, 50});
  std::string fault;
  const JpegPicture decoded = decodeJpeg(jpegOf({"", std::make_shared<const RawPicture>(picture)}), fault);
  EXPECT_EQ(fault, "");
  ASSERT_EQ(decoded.columns, 16u);
  ASSERT_EQ(decoded.rows, 8u);
  EXPECT_NEAR(decoded.values[0], 200, 3);
  EXPECT_NEAR(decoded.values[1], 100, 3);
  EXPECT_NEAR(decoded.values[2], 50, 3);
  EXPECT_EQ(jpegOf({"a file"}), "a file");
}

}  // namespace
}  // namespace robosim
