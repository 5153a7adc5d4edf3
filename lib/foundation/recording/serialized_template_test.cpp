#include "recording/serialized_template.h"

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
SerializedTemplate::Number number(const Value& value) {
  return std::as_bytes(std::span(&value, 1));
}

std::vector<SerializedTemplate::Number> numbersOf(const CObservationRange& range) {
  std::vector<SerializedTemplate::Number> numbers{number(range.timestamp)};
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

TEST(SerializedTemplate, WritesTheSameBytesAsMrpt) {
  for (const std::size_t beams : {0, 1, 2, 16, 100}) {
    CObservationRange range = ring(beams);
    auto serialized = SerializedTemplate::of(range, numbersOf(range), [&](int step) { measure(range, step); });
    ASSERT_TRUE(serialized);
    for (int step = 2; step < 20; ++step) {
      measure(range, step);
      ByteArchive archive;
      serialized->append(archive);
      EXPECT_EQ(archive.bytes, asMrptWrites(range)) << beams << " beams, step " << step;
    }
  }
}

TEST(SerializedTemplate, AppendsToExistingBytes) {
  CObservationRange range = ring(1);
  auto serialized = SerializedTemplate::of(range, numbersOf(range), [&](int step) { measure(range, step); });
  ByteArchive archive;
  serialized->append(archive);
  serialized->append(archive);
  EXPECT_EQ(archive.bytes.size(), 2 * asMrptWrites(range).size());
}

TEST(SerializedTemplate, IsNotCreatedWhenANumberDoesNotOccur) {
  CObservationRange range = ring(1);
  const double elsewhere = 0.123456789;
  EXPECT_FALSE(SerializedTemplate::of(range, {number(elsewhere)}, [](int) {}));
}

TEST(SerializedTemplate, IsNotCreatedWhenANumberOccursTwice) {
  CObservationOdometry odometry;
  EXPECT_FALSE(SerializedTemplate::of(odometry, {number(odometry.odometry.x())}, [&](int) {
    odometry.odometry.x(0.75);
    odometry.odometry.y(0.75);
  }));
}

TEST(SerializedTemplate, IsNotCreatedWhenOtherBytesChange) {
  CObservationRange range = ring(2);
  auto listed = numbersOf(range);
  listed.pop_back();
  EXPECT_FALSE(SerializedTemplate::of(range, listed, [&](int step) { measure(range, step); }));
}

}  // namespace
}  // namespace robosim
