#include "recording/mcap_recording.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>

#include <gtest/gtest.h>

#include "base/error_list.h"
#include "mcap/reader.h"
#include "recording/testing/recorded_steps_test.h"

namespace robosim {
namespace {

constexpr std::size_t kMcapSteps = 60;

struct McapRecordingTest : RecordedStepsTest {
  McapRecordingTest() {
    file_ = in("run.mcap");
    record(kMcapSteps);
  }
  void expectSteps(const RecordedSteps&, std::size_t step, const std::vector<RecordedRobot>& read) const {
    for (std::size_t robot = 0; robot < 2; ++robot) {
      for (std::size_t i = 0; i < robots_[robot].sensors->size(); ++i) {
        expectSameReading(read[robot].readings.measurements[i], written_[step][robot].measurements[i],
                          (*robots_[robot].sensors)[i].label);
      }
      EXPECT_EQ(read[robot].readings.inbox, written_[step][robot].inbox);
      EXPECT_EQ(read[robot].command, commands_[step][robot]);
      EXPECT_EQ(read[robot].world_from_robot->x, truth_[step][robot].x);
    }
  }
};

std::string errorOf(const std::function<void()>& act) {
  try {
    act();
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "";
}

TEST_F(McapRecordingTest, HasWhatARawlogHas) {
  RawlogReader reader(file_);
  RecordedSteps steps(reader, robots_, 0.1);
  for (std::size_t step = 0; step < kMcapSteps; ++step) {
    const auto read = steps.next();
    ASSERT_TRUE(read) << step;
    expectSteps(steps, step, *read);
  }
  EXPECT_FALSE(steps.next());
  EXPECT_EQ(steps.note(), "last note");
  EXPECT_EQ(reader.readError(), std::nullopt);
}

TEST_F(McapRecordingTest, ContinuesAtAnyStep) {
  RawlogReader reader(file_, RawlogReader::Access::random);
  RecordedSteps steps(reader, robots_, 0.1);
  std::vector<std::uint64_t> places;
  for (std::size_t step = 0; step < kMcapSteps; ++step) {
    places.push_back(steps.position());
    ASSERT_TRUE(steps.next());
  }
  for (const std::size_t step : {59u, 0u, 31u, 30u, 32u}) {
    steps.seek(places[step]);
    const auto read = steps.next();
    ASSERT_TRUE(read) << step;
    expectSteps(steps, step, *read);
  }
}

TEST_F(McapRecordingTest, HasAMessageOfEachTopicForEachStep) {
  mcap::Reader reader(file_);
  std::map<std::string, std::size_t> count;
  std::uint64_t last_ns = 0;
  while (const auto message = reader.next()) {
    const std::string& topic = reader.channels().at(message->channel).topic;
    EXPECT_GE(message->log_time_ns, last_ns);
    last_ns = message->log_time_ns;
    const std::size_t step = count[topic]++;
    if (topic != "/a/scan") continue;
    const auto scan = ros::decode<ros::LaserScan>(message->data);
    EXPECT_EQ(message->log_time_ns, step * 100'000'000);
    const auto& echoes = std::get<Echoes>(written_[step][0].measurements[1]);
    for (std::size_t i = 0; i < echoes.size(); ++i) {
      const bool has_echo = echoes[i].range_m < 8;
      EXPECT_EQ(scan.ranges[i], has_echo ? echoes[i].range_m : INFINITY);
    }
  }
  for (const char* topic : {"/clock", "/a/scan", "/b/scan", "/a/odom", "/a/ground_truth", "/a/cmd_vel", "/b/battery",
                            "/a/sonar/range_15", "/a/sonar/points", "/a/bumper", "/a/air", "/a/beam/range_0"}) {
    EXPECT_EQ(count[topic], kMcapSteps) << topic;
  }
  EXPECT_EQ(count["/tf_static"], 1u);
  EXPECT_EQ(count["/tf"], 2 * kMcapSteps);
  EXPECT_EQ(count[kRawlogTopic], kMcapSteps + 2) << "with the notes";
}

TEST_F(McapRecordingTest, DescribesItsChannelsForRosbag2) {
  mcap::Reader reader(file_);
  EXPECT_EQ(reader.header().profile, "ros2");
  EXPECT_TRUE(reader.contents().has_summary);
  for (const auto& [id, channel] : reader.channels()) {
    const mcap::Schema& schema = reader.schemas().at(channel.schema_id);
    EXPECT_EQ(schema.encoding, "ros2msg");
    EXPECT_EQ(channel.message_encoding, "cdr");
    EXPECT_TRUE(channel.metadata.at("offered_qos_profiles").starts_with("- history: 1\n")) << channel.topic;
    EXPECT_TRUE(channel.metadata.at("topic_type_hash").starts_with("RIHS01_")) << channel.topic;
  }
  ASSERT_EQ(reader.contents().metadata.size(), 1u);
  EXPECT_EQ(reader.metadata(reader.contents().metadata[0]), (mcap::Metadata{"rosbag2", {{"serialized_metadata", ""}}}));
}

TEST_F(McapRecordingTest, IsReadableUpToItsLastWholeChunkWhenItIsCutOff) {
  record(300);
  const auto chunks = mcap::Reader(file_).contents().chunks;
  ASSERT_GT(chunks.size(), 2u);
  std::filesystem::resize_file(file_, chunks.back().chunk_start + chunks.back().chunk_length - 1);
  RawlogReader reader(file_);
  while (reader.next()) {
  }
  EXPECT_TRUE(reader.endsEarly());
  EXPECT_FALSE(reader.isDamaged());
}

TEST_F(McapRecordingTest, RefusesSensoryFramesAndExternalImages) {
  EXPECT_EQ(errorOf([&] { RawlogWriter(file_, robots_, RawlogFormat::sensory_frames); }),
            file_.string() + ": an MCAP file has no sensory frames; record observations, or a .rawlog");
  EXPECT_EQ(errorOf([&] { RawlogWriter(file_, robots_, RawlogFormat::observations, RawlogImages::external); }),
            file_.string() + ": an MCAP file has all pictures; record them embedded, or a .rawlog");
}

TEST_F(McapRecordingTest, RefusesAnEmptyMcapFileOfAnotherProgram) {
  const auto other = in("other.mcap");
  {
    std::ofstream out(other, std::ios::binary);
    mcap::Writer writer(
        [&](std::span<const std::uint8_t> bytes) {
          out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
        },
        {"ros2", "other"});
    writer.finish();
  }
  EXPECT_EQ(errorOf([&] { RawlogReader(other).next(); }),
            other.string() + ": contains no message; it is an empty recording of ROS 2");
}

}  // namespace
}  // namespace robosim
