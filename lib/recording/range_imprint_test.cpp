#include "recording/range_imprint.h"

#include <gtest/gtest.h>

#include "base/random.h"

namespace robosim {
namespace {

using mrpt::obs::CObservationRange;

CObservationRange ring(std::size_t beams) {
  CObservationRange range;
  range.sensorLabel = "rover/sonar";
  for (std::size_t i = 0; i < beams; ++i) {
    CObservationRange::TMeasurement sensed;
    sensed.sensorID = static_cast<std::uint16_t>(i);
    sensed.sensorPose = {0.1, 0.2, 0.3, 0.4 * static_cast<double>(i), 0, 0};
    range.sensedData.push_back(sensed);
  }
  return range;
}

std::vector<std::uint8_t> asMrptWrites(const CObservationRange& range) {
  ByteArchive archive;
  archive << range;
  return archive.bytes;
}

TEST(RangeImprint, WritesWhatMrptWritesByteForByte) {
  Rng rng(1);
  for (const std::size_t beams : {0, 1, 2, 16, 100}) {
    CObservationRange range = ring(beams);
    RangeImprint imprint(range);
    for (int step = 0; step < 20; ++step) {
      range.timestamp = mrpt::Clock::fromDouble(1.1e9 + step);
      for (auto& sensed : range.sensedData) sensed.sensedDistance = static_cast<float>(rng.uniform(0, 5));
      ByteArchive archive;
      imprint.append(range, archive);
      EXPECT_EQ(archive.bytes, asMrptWrites(range)) << beams << " beams, step " << step;
    }
  }
}

TEST(RangeImprint, AppendsToWhatIsThere) {
  CObservationRange range = ring(1);
  RangeImprint imprint(range);
  ByteArchive archive;
  imprint.append(range, archive);
  imprint.append(range, archive);
  EXPECT_EQ(archive.bytes.size(), 2 * asMrptWrites(range).size());
}

TEST(RangeImprint, FollowsABeamThatTurns) {
  CObservationRange range = ring(1);
  RangeImprint imprint(range);
  range.sensedData[0].sensorPose.yaw = 1;
  ByteArchive archive;
  imprint.append(range, archive);
  EXPECT_EQ(archive.bytes, asMrptWrites(range));
}

}  // namespace
}  // namespace robosim
