#include "serving/ros2_serving.h"

#include <cmath>
#include <limits>
#include <map>
#include <mutex>

#include <gtest/gtest.h>

#include "base/error_list.h"
#include "ros/cdr.h"
#include "run/local_run.h"

namespace robosim {
namespace {

/// A participant of the test, which sees what is written and sends to readers.
struct FakeDomain {
  struct FakeWriter final : dds::Writer {
    explicit FakeWriter(FakeDomain& of, std::string topic) : domain(of), name(std::move(topic)) {
      const std::lock_guard lock(domain.mutex);
      ++domain.writers[name];
    }
    ~FakeWriter() override {
      const std::lock_guard lock(domain.mutex);
      --domain.writers[name];
    }
    int readers() const override { return domain.readers[name]; }
    std::uint64_t arrivals() const override { return static_cast<std::uint64_t>(domain.readers[name]); }
    void write(std::vector<std::uint8_t> message) override { domain.written[name].push_back(std::move(message)); }
    FakeDomain& domain;
    std::string name;
  };
  struct FakeReader final : dds::Reader {
    FakeReader(FakeDomain& of, std::string key, dds::OnSample on_sample) : domain(of), name(std::move(key)) {
      domain.takers[name] = std::move(on_sample);
    }
    ~FakeReader() override { domain.takers.erase(name); }
    int writers() const override { return 0; }
    FakeDomain& domain;
    std::string name;
  };
  struct FakeParticipant final : dds::Participant {
    explicit FakeParticipant(FakeDomain& of) : domain(of) {}
    std::unique_ptr<dds::Writer> write(const Topic& topic) override {
      return std::make_unique<FakeWriter>(domain, topic.name);
    }
    std::unique_ptr<dds::Reader> read(const Topic& topic, dds::Receipt, dds::OnSample on_sample) override {
      return std::make_unique<FakeReader>(domain, topic.name + " " + topic.type->name, std::move(on_sample));
    }
    std::uint64_t lost() const override { return 0; }
    FakeDomain& domain;
  };

  template <ros::Message M>
  void send(const std::string& topic, const M& message, std::uint64_t writer = 1) {
    std::vector<std::uint8_t> bytes;
    ros::encode(message, bytes);
    takers.at(topic + " " + M::kType)({bytes, writer});
  }
  bool isRead(const std::string& topic, const char* type) const { return takers.count(topic + " " + type) > 0; }

  int writersOf(const std::string& topic) {
    const std::lock_guard lock(mutex);
    return writers[topic];
  }

  std::mutex mutex;
  std::map<std::string, int> writers;  ///< by topic; guarded by the mutex: they may end in another thread
  std::map<std::string, int> readers;  ///< by topic
  std::map<std::string, std::vector<std::vector<std::uint8_t>>> written;
  std::map<std::string, dds::OnSample> takers;  ///< by topic and type
};

/// Two robots whose controllers do nothing.
struct Ros2ServingTest : testing::Test {
  RunOptions options = [] {
    RunOptions made;
    made.controller = "still";
    return made;
  }();
  LocalRun run{loadWorldToRun(ROBOSIM_SOURCE_DIR "/worlds/small_maze.xml", "still"), options};
  std::string log;
  FakeDomain domain;
  RobotDrivers drivers{{}, [this](const std::string& line) { log += line + "\n"; }};
  Ros2Options ros2 = [this] {
    Ros2Options made;
    made.dds.log = [this](const std::string& line) { log += line + "\n"; };
    made.join = [this](const dds::Options&) { return std::make_unique<FakeDomain::FakeParticipant>(domain); };
    made.may_supervise = true;
    return made;
  }();
  std::optional<Ros2Serving> serving;

  void begin() {
    serving.emplace(ros2, drivers);
    drivers.begin(run, {"", ""});
    serving->begin(run.environment());
  }
  void poll() {
    serving->poll([this](const Intervention& change) { return run.environment().apply(change); });
    if (run.environment().robotCount() == 2) return;
    run.followAdditions();
    drivers.addRobots(run, std::vector<std::string>(run.environment().robotCount()));
    serving->addRobots();
  }
  void step() {
    run.step();
    serving->stepped();
  }
  /// The command of a robot in the next step.
  const Command& command(std::size_t robot = 0) {
    run.step();
    return run.environment().state().commands[robot];
  }
};

TEST_F(Ros2ServingTest, WritesTheTopicsOfARunButCommandsOfRobots) {
  begin();
  for (const char* const topic : {"/clock", "/tf", "/tf_static", "/map", "/Pioneer1/odom", "/Scout1/sonar/range_0"}) {
    EXPECT_EQ(domain.writersOf(topic), 1) << topic;
  }
  EXPECT_EQ(domain.writersOf("/Pioneer1/cmd_vel"), 0);
  step();
  EXPECT_TRUE(domain.written.empty()) << "without readers";
  domain.readers["/clock"] = 1;
  step();
  EXPECT_EQ(domain.written["/clock"].size(), 1u);
  EXPECT_EQ(ros::decode<ros::Clock>(domain.written["/clock"][0]).clock, (ros::Time{0, 200'000'000}));
}

TEST_F(Ros2ServingTest, WritesTheStateForEachNewReaderOfALatchedTopic) {
  begin();
  domain.readers["/map"] = 1;
  poll();
  EXPECT_EQ(domain.written["/map"].size(), 1u) << "also while the run is paused";
  poll();
  step();
  EXPECT_EQ(domain.written["/map"].size(), 1u);
  domain.readers["/map"] = 2;
  step();
  EXPECT_EQ(domain.written["/map"].size(), 2u);
  serving->begin(run.environment());
  poll();
  EXPECT_EQ(domain.written["/map"].size(), 3u) << "of the next run";
}

TEST_F(Ros2ServingTest, EndsTheTopicsOfTheRunBefore) {
  LocalRun next{loadWorldToRun(ROBOSIM_SOURCE_DIR "/worlds/opho2_1.xml", "still"), options};
  begin();
  drivers.begin(next, std::vector<std::string>(next.environment().robotCount()));
  serving->begin(next.environment());
  EXPECT_EQ(domain.writersOf("/clock"), 1);
  const std::string of_next = "/" + next.environment().robotNames()[0] + "/odom";
  EXPECT_EQ(domain.writersOf(of_next), 1);
  serving.reset();
  for (const auto& [topic, count] : domain.writers) EXPECT_EQ(count, 0) << topic;
  EXPECT_TRUE(domain.takers.empty());
}

TEST_F(Ros2ServingTest, PutsANamespaceBeforeAllTopicsButThoseOfTimeAndFrames) {
  ros2.name_space = ros2Namespace("team/a");
  begin();
  EXPECT_EQ(domain.writersOf("/team/a/Pioneer1/odom"), 1);
  EXPECT_EQ(domain.writersOf("/clock"), 1);
  EXPECT_EQ(domain.writersOf("/tf"), 1);
  EXPECT_TRUE(domain.isRead("/team/a/Pioneer1/cmd_vel", ros::Twist::kType));
  EXPECT_TRUE(domain.isRead("/team/a/robosim/spawn", ros::String::kType));
}

TEST_F(Ros2ServingTest, HasATreeOfFramesForEachRobotIfRequested) {
  ros2.form.frames = FrameNames::plain;
  ros2.name_space = "/team";
  begin();
  EXPECT_EQ(domain.writersOf("/tf"), 0);
  EXPECT_EQ(domain.writersOf("/tf_static"), 0);
  domain.readers["/team/Pioneer1/tf"] = 1;
  domain.readers["/team/Scout1/tf_static"] = 1;
  step();
  const auto transform = ros::decode<ros::TFMessage>(domain.written["/team/Pioneer1/tf"].at(0)).transforms.at(0);
  EXPECT_EQ(transform.header.frame_id, "odom");
  EXPECT_EQ(transform.child_frame_id, "base_link");
  const auto mounts = ros::decode<ros::TFMessage>(domain.written["/team/Scout1/tf_static"].at(0)).transforms;
  ASSERT_FALSE(mounts.empty());
  for (const auto& mount : mounts) EXPECT_EQ(mount.header.frame_id, "base_link");
  EXPECT_EQ(domain.written.count("/team/Pioneer1/tf_static"), 0u) << "without readers";
}

TEST(Ros2Namespace, IsThatOfRos2) {
  EXPECT_EQ(ros2Namespace(""), "");
  EXPECT_EQ(ros2Namespace("/"), "");
  EXPECT_EQ(ros2Namespace("/lab/team_1"), "/lab/team_1");
  for (const char* const invalid : {"1team", "team/", "a//b", "te am", "a/1b"}) {
    EXPECT_THROW(ros2Namespace(invalid), ConfigError) << invalid;
  }
}

TEST_F(Ros2ServingTest, DrivesRobotsByBothTypesOfCommands) {
  begin();
  domain.send("/Pioneer1/cmd_vel", ros::Twist{{0.2, 0, 0}, {0, 0, 0.1}});
  EXPECT_EQ(command().speed_mps, 0.2);
  domain.send("/Pioneer1/cmd_vel", ros::TwistStamped{{{}, ""}, {{0.1, 0, 0}, {0, 0, 0.5}}});
  EXPECT_EQ(command().turn_radps, 0.5);
  EXPECT_NE(log.find("anyone (domain 0): drive Pioneer1"), std::string::npos) << log;
  domain.send("/Pioneer1/cmd_vel", ros::Twist{{-0.2, 0, 0}, {}}, 2);
  EXPECT_EQ(command().speed_mps, 0.1) << "of the robot's driver";
  EXPECT_NE(log.find("/Pioneer1/cmd_vel of ROS 2 has no effect: Pioneer1 is driven by another client, ROS 2 at"),
            std::string::npos)
      << log;
}

TEST_F(Ros2ServingTest, DrivesNothingUnlessItIsPermitted) {
  ros2.may_drive = false;
  ros2.may_supervise = false;
  begin();
  EXPECT_TRUE(domain.takers.empty());
}

TEST_F(Ros2ServingTest, PlacesARobot) {
  begin();
  ros::PoseWithCovarianceStamped pose;
  pose.header.frame_id = "map";
  pose.pose.pose = {{1.5, -0.5, 0}, {0, 0, std::sqrt(0.5), std::sqrt(0.5)}};
  domain.send("/Pioneer1/initialpose", pose);
  poll();
  ASSERT_EQ(run.environment().state().interventions.size(), 1u) << log;
  const auto& change = std::get<PlaceBody>(run.environment().state().interventions[0].intervention.change);
  EXPECT_EQ(change.name, "Pioneer1");
  EXPECT_EQ(change.x_m, 1.5);
  EXPECT_EQ(change.y_m, -0.5);
  EXPECT_DOUBLE_EQ(*change.heading_rad, M_PI / 2);
  EXPECT_NE(log.find("anyone (domain 0): <place name=\"Pioneer1\""), std::string::npos) << log;
}

TEST_F(Ros2ServingTest, RefusesPosesThatAreNoneOfTheWorld) {
  ros::PoseWithCovarianceStamped pose;
  pose.pose.pose.orientation = {0, 0, 0, 2};
  EXPECT_EQ(placeOf("Ann", pose).heading_rad, 0.0) << "it need not be normalised";
  pose.pose.pose.orientation = {};
  pose.pose.pose.orientation.w = 0;
  EXPECT_THROW(placeOf("Ann", pose), ConfigError);
  pose.pose.pose.orientation.w = 1;
  pose.header.frame_id = "odom";
  EXPECT_THROW(placeOf("Ann", pose), ConfigError);
  pose.header.frame_id = "map";
  pose.pose.pose.position.x = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(placeOf("Ann", pose), ConfigError);
}

TEST_F(Ros2ServingTest, AddsARobotWithItsTopicsAndRemovesIt) {
  begin();
  domain.send("/robosim/spawn", ros::String{R"(<robot name="New" model="scout" x="0" y="0"/>)"});
  poll();
  ASSERT_EQ(run.environment().robotCount(), 3u) << log;
  EXPECT_EQ(domain.writersOf("/New/odom"), 1);
  EXPECT_EQ(domain.writersOf("/Pioneer1/odom"), 1);
  domain.send("/New/cmd_vel", ros::Twist{{0.3, 0, 0}, {}});
  EXPECT_EQ(command(2).speed_mps, 0.3);
  EXPECT_TRUE(domain.isRead("/New/initialpose", ros::PoseWithCovarianceStamped::kType));
  domain.send("/robosim/remove", ros::String{"New"});
  poll();
  EXPECT_TRUE(run.environment().state().isAbsent(2));
}

TEST_F(Ros2ServingTest, LogsChangesThatAreRefused) {
  begin();
  domain.send("/robosim/remove", ros::String{"Unknown"});
  domain.send("/robosim/spawn", ros::String{"<robot"});
  poll();
  EXPECT_NE(log.find("of ROS 2 has no effect: "), std::string::npos) << log;
  EXPECT_NE(log.find("/robosim/spawn of ROS 2 has no effect: "), std::string::npos) << log;
  EXPECT_TRUE(run.environment().state().interventions.empty());
  for (std::size_t i = 0; i < Ros2Changes::kMaxWaiting + 1; ++i) domain.send("/robosim/remove", ros::String{"Unknown"});
  EXPECT_NE(log.find("a change of ROS 2 is dropped: 64 already wait"), std::string::npos) << log;
}

}  // namespace
}  // namespace robosim
