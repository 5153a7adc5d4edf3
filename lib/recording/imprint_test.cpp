#include "recording/imprint.h"

#include <gtest/gtest.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationRange.h>

#include "base/random.h"

namespace robosim {
namespace {

using mrpt::obs::CObservationOdometry;
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

template <typename Value>
Imprint::Number number(const Value& value) {
  return std::as_bytes(std::span(&value, 1));
}

std::vector<Imprint::Number> numbersOf(const CObservationRange& range) {
  std::vector<Imprint::Number> numbers{number(range.timestamp)};
  for (const auto& sensed : range) numbers.push_back(number(sensed.sensedDistance));
  return numbers;
}

void measure(CObservationRange& range, int step) {
  Rng rng(static_cast<std::uint64_t>(step));
  range.timestamp = mrpt::Clock::fromDouble(1.1e9 + step);
  for (auto& sensed : range.sensedData) sensed.sensedDistance = static_cast<float>(rng.uniform(0, 5));
}

std::vector<std::uint8_t> asMrptWrites(const mrpt::obs::CObservation& observation) {
  ByteArchive archive;
  archive << observation;
  return archive.bytes;
}

TEST(Imprint, WritesWhatMrptWritesByteForByte) {
  for (const std::size_t beams : {0, 1, 2, 16, 100}) {
    CObservationRange range = ring(beams);
    auto imprint = Imprint::of(range, numbersOf(range), [&](int step) { measure(range, step); });
    ASSERT_TRUE(imprint);
    for (int step = 2; step < 20; ++step) {
      measure(range, step);
      ByteArchive archive;
      imprint->append(archive);
      EXPECT_EQ(archive.bytes, asMrptWrites(range)) << beams << " beams, step " << step;
    }
  }
}

TEST(Imprint, AppendsToWhatIsThere) {
  CObservationRange range = ring(1);
  auto imprint = Imprint::of(range, numbersOf(range), [&](int step) { measure(range, step); });
  ByteArchive archive;
  imprint->append(archive);
  imprint->append(archive);
  EXPECT_EQ(archive.bytes.size(), 2 * asMrptWrites(range).size());
}

TEST(Imprint, IsNotMadeWhenANumberStandsNowhere) {
  CObservationRange range = ring(1);
  const double elsewhere = 0.123456789;
  EXPECT_FALSE(Imprint::of(range, {number(elsewhere)}, [](int) {}));
}

TEST(Imprint, IsNotMadeWhenANumberStandsAtTwoPlaces) {
  CObservationOdometry odometry;
  EXPECT_FALSE(Imprint::of(odometry, {number(odometry.odometry.x())}, [&](int) {
    odometry.odometry.x(0.75);
    odometry.odometry.y(0.75);
  }));
}

TEST(Imprint, IsNotMadeWhenMoreChangesThanIsTold) {
  CObservationRange range = ring(2);
  auto told = numbersOf(range);
  told.pop_back();
  EXPECT_FALSE(Imprint::of(range, told, [&](int step) { measure(range, step); }));
}

}  // namespace
}  // namespace robosim
