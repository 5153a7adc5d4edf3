#include "hardware/measurement.h"

#include <gtest/gtest.h>

#include "hardware/measurement_fields.h"

namespace robosim {
namespace {

/// The names and values of a measurement's numbers: "0.range 1.5 0.x 1 …".
template <typename M>
std::string numbersIn(const M& measurement) {
  std::string text;
  forNumbers(measurement, [&](const auto& field, auto number, std::size_t record) {
    text += (text.empty() ? "" : " ") + std::to_string(record) + '.' + field.name + ' ' +
            std::to_string(static_cast<int>(number));
  });
  return text;
}

TEST(Measurement, HasItsNumbersRecordByRecord) {
  EXPECT_EQ(numbersIn(Echoes{{1, {2, 3, 4}}, {5, {6, 7, 8}}}),
            "0.range 1 0.x 2 0.y 3 0.z 4 1.range 5 1.x 6 1.y 7 1.z 8");
  EXPECT_EQ(numbersIn(Scalar{7}), "0.value 7");
  EXPECT_EQ(numbersIn(Contacts{{1, 0}}), "0.pressed 1 1.pressed 0");
  EXPECT_EQ(numbersIn(Odometry{{1, 2, 3}, 4, 5, 6}), "0.x 1 0.y 2 0.heading 3 0.speed 4 0.turn 5 0.lateral 6");
  EXPECT_EQ(numbersIn(Image{"a file"}), "");
  EXPECT_EQ(numbersIn(Blobs{true, {{"red", 1, 2, 3, 4, 5, 6, 7}}}),
            "0.pixels 1 0.x 2 0.y 3 0.left 4 0.top 5 0.width 6 0.height 7");
  EXPECT_EQ(numbersIn(BeaconRanges{{3, 4}}), "0.range 3 1.range 4");
  EXPECT_EQ(numbersIn(Values{{9, 8}}), "0.value 9 1.value 8");
}

TEST(Measurement, OfSingleTypeIsKnownAtCompileTime) {
  static_assert(kConsistsOf<Echoes, float> && !kConsistsOf<Echoes, double>);
  static_assert(kConsistsOf<Contacts, std::uint8_t> && kConsistsOf<Values, double>);
  static_assert(!kConsistsOf<Blobs, float> && !kConsistsOf<Image, float>);
  static_assert(kIsDense<Echoes> && kIsDense<Odometry> && !kIsDense<Blobs>);
  static_assert(kIsReproducible<Echoes> && !kIsReproducible<Image> && !kIsReproducible<Blobs>);
  static_assert(kIsSingle<Scalar> && !kIsSingle<Values> && kIsFile<Image> && !kIsFile<Blobs>);
}

TEST(Measurement, IsInitiallyBlankAndOfTheSensorsSize) {
  SensorInfo sensor;
  sensor.beams.resize(3);
  sensor.no_echo_m = 50;
  sensor.colors = {"gold", "red"};
  sensor.quantities = {{"co2", "ppm"}};
  const auto blank = [&](SensorKind kind) {
    sensor.kind = kind;
    return blankMeasurement(sensor);
  };
  EXPECT_EQ(blank(SensorKind::laser), Measurement(Echoes(3)));
  EXPECT_EQ(blank(SensorKind::compass), Measurement(Scalar{}));
  EXPECT_EQ(blank(SensorKind::bumper), Measurement(Contacts{{0, 0, 0}}));
  EXPECT_EQ(blank(SensorKind::odometry), Measurement(Odometry{}));
  EXPECT_EQ(blank(SensorKind::camera), Measurement(Image{}));
  EXPECT_EQ(blank(SensorKind::blob_finder), Measurement(Blobs{false, {{"gold"}, {"red"}}}));
  EXPECT_EQ(blank(SensorKind::beacons), Measurement(BeaconRanges{{50, 50, 50}}));
  EXPECT_EQ(blank(SensorKind::values), Measurement(Values{{0}}));
  EXPECT_EQ(blank(SensorKind::unknown), Measurement(Values{}));
}

TEST(Measurement, IsAbsentInStepsWithoutAnImageOnly) {
  EXPECT_FALSE(isPresent(Image{}));
  EXPECT_TRUE(isPresent(Image{"a file"}));
  EXPECT_FALSE(isPresent(Blobs{}));
  EXPECT_TRUE(isPresent(Blobs{true, {}}));
  EXPECT_TRUE(isPresent(Echoes{}));
  SensorInfo sensor;
  for (std::size_t i = 0; i < kSensorKindNames.size(); ++i) {
    sensor.kind = static_cast<SensorKind>(i);
    const bool expected = sensor.kind == SensorKind::camera || sensor.kind == SensorKind::blob_finder;
    EXPECT_EQ(isIntermittent(sensor), expected) << nameOf(sensor.kind);
  }
}

template <typename M>
std::string faultWith(M measurement, const std::vector<double>& numbers) {
  return setNumbers(measurement, std::span<const double>(numbers));
}

TEST(Measurement, RejectsNumbersBeyondTheirBounds) {
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(faultWith(Scalar{}, {-1e300}), "");
  EXPECT_EQ(faultWith(Scalar{}, {infinity}), "a value of inf; it must be a finite number");
  EXPECT_EQ(faultWith(Contacts{{0, 0}}, {0, 1}), "");
  EXPECT_EQ(faultWith(Contacts{{0, 0}}, {0, 2}), "segment 1: a pressed of 2; it must lie in [0, 1]");
  EXPECT_EQ(faultWith(Blobs{false, {{"red"}}}, {6, 10.5, 11.5, 10, 11, 2, 3}), "");
  EXPECT_EQ(faultWith(Blobs{false, {{"red"}}}, {7, 10.5, 11.5, 10, 11, 2, 3}), "a blob outside the image")
      << "7 pixels in 2 × 3";
  EXPECT_EQ(faultWith(Blobs{false, {{"red"}}}, {6, 10.5, 11.5, 10, 2049, 2, 3}),
            "blob 0: a top of 2049 px; it must lie in [0, 2048 px]");
  EXPECT_EQ(faultWith(Blobs{false, {{"red"}}}, {6, 2047.5, 11.5, 2046, 11, 2, 3}), "");
  EXPECT_EQ(faultWith(Blobs{false, {{"red"}}}, {6, 2047.5, 11.5, 2047, 11, 2, 3}), "a blob outside the image")
      << "columns 2047 and 2048 of 2048";
}

TEST(Measurement, RejectsPicturesThatAreTooLargeOrCutOff) {
  const auto fault_of = [](std::size_t bytes, const std::string& end) {
    std::string jpeg = "\xFF\xD8";
    jpeg.resize(bytes - end.size(), 'x');
    return Description<Image>::fileFaultOf(jpeg + end);
  };
  EXPECT_EQ(Description<Image>::fileFaultOf(""), "") << "no picture in this step";
  EXPECT_EQ(fault_of(100, "\xFF\xD9"), "");
  EXPECT_EQ(fault_of(100, "x"), "a picture that is no JPEG file");
  EXPECT_EQ(fault_of(kPictureBytesMax, "\xFF\xD9"), "");
  EXPECT_EQ(fault_of(kPictureBytesMax + 1, "\xFF\xD9"), "a picture of 16777217 bytes; the most is 16777216");
}

}  // namespace
}  // namespace robosim
