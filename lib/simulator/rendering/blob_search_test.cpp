#include "rendering/blob_search.h"

#include <cmath>

#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "base/angle_units.h"

namespace robosim {
namespace {

const cv::Scalar kGoldenPaint(26, 204, 255), kShadedPaint(10, 80, 100), kRedPaint(20, 20, 200), kRosyPaint(70, 20, 200),
    kBluePaint(200, 60, 20);

/// A grey picture with rectangles, as a JPEG file.
struct Painting {
  cv::Mat picture{240, 320, CV_8UC3, cv::Scalar(140, 140, 140)};

  Painting& with(const cv::Rect& where, const cv::Scalar& color) {
    cv::rectangle(picture, where, color, cv::FILLED);
    return *this;
  }
  std::string jpeg(int quality = 90) const {
    std::vector<unsigned char> bytes;
    cv::imencode(".jpg", picture, bytes, {cv::IMWRITE_JPEG_QUALITY, quality});
    return {bytes.begin(), bytes.end()};
  }
};

TargetColor gold() { return {.name = "gold", .hue_rad = toRadians(47)}; }
TargetColor red() { return {.name = "red", .hue_rad = 0}; }

Blob onlyBlob(const std::string& jpeg, const TargetColor& color, unsigned pixels_min = 4) {
  const auto blobs = findBlobs(jpeg, {color}, pixels_min);
  EXPECT_EQ(blobs.size(), 1u);
  return blobs.at(0);
}

/// Tolerance for JPEG, which blurs colours along edges by a pixel or two.
void expectBlobAt(const Blob& blob, const cv::Rect& where) {
  EXPECT_NEAR(blob.left_px, where.x, 2);
  EXPECT_NEAR(blob.top_px, where.y, 2);
  EXPECT_NEAR(blob.width_px, where.width, 3);
  EXPECT_NEAR(blob.height_px, where.height, 3);
  EXPECT_NEAR(blob.x_px, where.x + (where.width - 1) / 2.0, 1);
  EXPECT_NEAR(blob.y_px, where.y + (where.height - 1) / 2.0, 1);
  EXPECT_NEAR(blob.pixels, where.area(), 0.1 * where.area() + 8);
}

TEST(BlobSearch, FindsABlobAndItsPosition) {
  const cv::Rect where(100, 60, 40, 90);
  const Blob blob = onlyBlob(Painting().with(where, kGoldenPaint).jpeg(), gold());
  EXPECT_EQ(blob.color, "gold");
  expectBlobAt(blob, where);
}

TEST(BlobSearch, FindsAColourInTheShade) {
  const cv::Rect where(100, 60, 40, 90);
  expectBlobAt(onlyBlob(Painting().with(where, kShadedPaint).jpeg(), gold()), where);
}

TEST(BlobSearch, ReportsTheLargestBlob) {
  const cv::Rect large(200, 100, 50, 50);
  expectBlobAt(onlyBlob(Painting().with({20, 20, 30, 30}, kGoldenPaint).with(large, kGoldenPaint).jpeg(), gold()),
               large);
}

TEST(BlobSearch, FindsEachColourAmongOthers) {
  const cv::Rect golden(20, 20, 60, 60), reddish(150, 90, 80, 40);
  const auto blobs = findBlobs(
      Painting().with(golden, kGoldenPaint).with(reddish, kRedPaint).with({240, 180, 60, 40}, kBluePaint).jpeg(),
      {red(), gold()}, 4);
  ASSERT_EQ(blobs.size(), 2u);
  expectBlobAt(blobs[0], reddish);
  expectBlobAt(blobs[1], golden);
}

TEST(BlobSearch, FindsRedOnBothSidesOfHueZero) {
  const cv::Rect where(100, 60, 60, 60);
  expectBlobAt(onlyBlob(Painting().with(where, kRosyPaint).jpeg(), red()), where);               // a hue of −17°
  expectBlobAt(onlyBlob(Painting().with(where, cv::Scalar(20, 60, 200)).jpeg(), red()), where);  // of +13°
}

TEST(BlobSearch, ReportsAnEmptyBlobForAGreyPicture) {
  EXPECT_EQ(onlyBlob(Painting().jpeg(), gold()), Blob{.color = "gold"});
}

TEST(BlobSearch, IgnoresSmallBlobs) {
  const std::string jpeg = Painting().with({100, 60, 5, 5}, kGoldenPaint).jpeg(100);
  EXPECT_GT(onlyBlob(jpeg, gold(), 4).pixels, 10u);
  EXPECT_EQ(onlyBlob(jpeg, gold(), 100).pixels, 0u);
}

TEST(BlobSearch, FindsNothingInInvalidPictures) {
  EXPECT_EQ(onlyBlob("", gold()).pixels, 0u);
  EXPECT_EQ(onlyBlob("\xFF\xD8 no picture \xFF\xD9", gold()).pixels, 0u);
}

}  // namespace
}  // namespace robosim
