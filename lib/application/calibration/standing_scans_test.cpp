#include "calibration/standing_scans.h"

#include <cmath>
#include <filesystem>
#include <functional>

#include <gtest/gtest.h>
#include <mrpt/io/CFileGZOutputStream.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/serialization/CArchive.h>

#include "base/angle_units.h"
#include "base/error_list.h"
#include "base/temporary_directory.h"

namespace robosim {
namespace {

/// A scan of ranges 1, 2 and 3 m over 180°.
mrpt::obs::CObservation2DRangeScan sampleScan(int number) {
  mrpt::obs::CObservation2DRangeScan scan;
  scan.timestamp = mrpt::Clock::fromDouble(1.2e9 + 0.1 * number);
  scan.aperture = static_cast<float>(M_PI);
  scan.maxRange = 80;
  scan.resizeScanAndAssign(3, 1, true);
  scan.setScanRange(1, 2);
  scan.setScanRange(2, 3);
  return scan;
}

class RecordedScans : public testing::Test {
 protected:
  using Change = std::function<void(mrpt::obs::CObservation2DRangeScan&, int number)>;

  /// Reads four scans, each after a change.
  ScanSeries readAfter(const Change& change, const std::string& sensor = "") const {
    const auto file = folder_.path() / "scans.rawlog";
    {
      mrpt::io::CFileGZOutputStream stream(file.string());
      auto archive = mrpt::serialization::archiveFrom(stream);
      for (int i = 0; i < 4; ++i) {
        auto scan = sampleScan(i);
        change(scan, i);
        archive << scan;
      }
    }
    return readScans(file.string(), sensor);
  }

  static mrpt::poses::CPose3D mounted(double x_m, double yaw_deg, double pitch_deg, double roll_deg) {
    return mrpt::poses::CPose3D(x_m, 0, 0.2, yaw_deg * kRadPerDeg, pitch_deg * kRadPerDeg, roll_deg * kRadPerDeg);
  }

  const TemporaryDirectory folder_;
};

using RangeList = std::vector<double>;

TEST_F(RecordedScans, AreAnticlockwiseWhateverTheScannersDirectionAndMountingAre) {
  const auto ranges = [&](bool right_to_left, double roll_deg) {
    const ScanSeries series = readAfter([&](mrpt::obs::CObservation2DRangeScan& scan, int) {
      scan.rightToLeft = right_to_left;
      scan.setSensorPose(mounted(0.3, 30, 0, roll_deg));
    });
    EXPECT_NEAR(series.robot_from_scanner.x, 0.3, 1e-9);
    EXPECT_NEAR(series.robot_from_scanner.phi, M_PI / 6, 1e-9);
    return series.scans.at(0).ranges_m;
  };
  EXPECT_EQ(ranges(true, 0), (RangeList{1, 2, 3}));
  EXPECT_EQ(ranges(false, 0), (RangeList{3, 2, 1}));
  EXPECT_EQ(ranges(true, 180), (RangeList{3, 2, 1}));
  EXPECT_EQ(ranges(false, 180), (RangeList{1, 2, 3}));
}

TEST_F(RecordedScans, HaveTheHeadingOfTheScannersAxisIfItIsPitchedOver) {
  // Half a turn about y: the x axis points backward, and the scanner is upside down.
  const ScanSeries series =
      readAfter([](mrpt::obs::CObservation2DRangeScan& scan, int) { scan.setSensorPose(mounted(0, 0, 180, 0)); });
  EXPECT_NEAR(std::abs(series.robot_from_scanner.phi), M_PI, 1e-6);
  EXPECT_EQ(series.scans.at(0).ranges_m, (RangeList{3, 2, 1}));
}

TEST_F(RecordedScans, OfOneLabelAndTwoPosesAreThoseOfTwoScanners) {
  const auto alternate = [](const std::string& label) {
    return [label](mrpt::obs::CObservation2DRangeScan& scan, int number) {
      scan.sensorLabel = label;
      const bool is_rear = number % 2 == 1;
      scan.setSensorPose(mounted(is_rear ? -0.2 : 0.2, is_rear ? 170 : 0, 0, 0));
      if (is_rear) scan.setScanRange(0, 7);
    };
  };
  for (const std::string label : {"", "LASER"}) {
    const ScanSeries rear = readAfter(alternate(label), label + "#2");
    EXPECT_EQ(rear.label, label + "#2");
    ASSERT_EQ(rear.scans.size(), 2u);
    for (const auto& scan : rear.scans) EXPECT_EQ(scan.ranges_m, (RangeList{7, 2, 3}));
    EXPECT_NEAR(rear.robot_from_scanner.x, -0.2, 1e-9);
    EXPECT_EQ(readAfter(alternate(label), label + "#1").scans.size(), 2u);
  }
  try {
    readAfter(alternate(""));
    FAIL() << "the choice is ambiguous";
  } catch (const ConfigError& error) {
    EXPECT_NE(error.errors().at(0).find("has scans of several sensors; choose one of them by --sensor: "
                                        "'#1' at (0.20, 0.00) m, 0°, '#2' at (-0.20, 0.00) m, 170°"),
              std::string::npos)
        << error.what();
  }
}

TEST_F(RecordedScans, OfOneLabelAndPoseAreThoseOfOneScanner) {
  const ScanSeries series = readAfter([](mrpt::obs::CObservation2DRangeScan& scan, int number) {
    scan.sensorLabel = "LASER";
    scan.setSensorPose(mounted(0.2 + 1e-6 * number, 0, 0, 0));
  });
  EXPECT_EQ(series.label, "LASER");
  EXPECT_EQ(series.scans.size(), 4u);
}

}  // namespace
}  // namespace robosim
