// Ros2Hardware with a robot of an Environment, whose topics are exchanged over the loopback interface.
#include "ros2/ros2_hardware.h"

#include <algorithm>
#include <atomic>
#include <functional>
#include <set>
#include <thread>

#include <gtest/gtest.h>

#include "control/robot.h"
#include "dds/cyclone/cyclone_participant.h"
#include "dds/testing/domain.h"
#include "environment/environment.h"
#include "maze/controllers.h"
#include "ros/cdr.h"
#include "run/local_run.h"
#include "topics/robot_topics.h"

namespace robosim {
namespace {

using dds::eventually;

std::shared_ptr<dds::Participant> join() { return dds::joinByCyclone({.domain = dds::testDomain()}); }

/// The first robot of a world, which is published and driven by topics: it takes a step when it has received a command.
class PublishedRobot final : TopicSink {
 public:
  explicit PublishedRobot(const std::string& world)
      : run_(loadWorldToRun(ROBOSIM_SOURCE_DIR "/worlds/" + world + ".xml", "still"), {}),
        topics_(info()),
        participant_(join()) {
    for (const Topic& topic : topics_.topics()) {
      writers_.push_back(topic.name.ends_with("/cmd_vel") ? nullptr : participant_->write(topic));
    }
    const TopicMessage mounts = staticTransforms(std::span(&topics_, 1), 0);
    mounts_ = participant_->write(mounts.topic);
    mounts_->write(mounts.data);
    commands_ = participant_->read({prefix() + "/cmd_vel", &ros::typeOf<ros::Twist>()}, dds::Receipt::reliable,
                                   [this](const dds::Sample& sample) {
                                     const auto twist = ros::decode<ros::Twist>(sample.message);
                                     speed_mps_ = twist.linear.x;
                                     turn_radps_ = twist.angular.z;
                                     ++received_;
                                   });
  }

  /// Namespace of its topics.
  std::string prefix() const { return "/" + topicNamePart(info().name); }
  const RobotInfo& info() const { return run_.environment().fleet().robots[0].info; }
  const State& state() const { return run_.environment().state(); }
  double commandedSpeed() const { return speed_mps_; }
  double commandedTurn() const { return turn_radps_; }
  int received() const { return received_; }
  /// Publishes the present readings, all but some topics.
  void publish(const std::set<std::string>& without = {}) {
    without_ = without;
    topics_.write(state().readings[0], RobotTruth{state().world_from_robot[0], {}}, std::nullopt, {}, *this);
  }
  void step() {
    run_.environment().setCommand(0, {.speed_mps = speed_mps_, .turn_radps = turn_radps_});
    run_.environment().step();
  }

 private:
  std::vector<std::uint8_t>& beginMessage(std::size_t topic) override {
    topic_ = topic;
    message_.clear();
    return message_;
  }
  void endMessage() override {
    const auto& writer = writers_[topic_];
    const std::string& name = topics_.topics()[topic_].name;
    if (writer && (name == "/tf" || without_.count(name.substr(prefix().size() + 1)) == 0)) writer->write(message_);
  }

  LocalRun run_;
  RobotTopics topics_;
  std::shared_ptr<dds::Participant> participant_;
  std::vector<std::unique_ptr<dds::Writer>> writers_;
  std::unique_ptr<dds::Writer> mounts_;
  std::size_t topic_ = 0;
  std::vector<std::uint8_t> message_;
  std::set<std::string> without_;
  std::atomic<double> speed_mps_{0}, turn_radps_{0};
  std::atomic<int> received_{0};
  std::unique_ptr<dds::Reader> commands_;
};

Ros2Hardware::Options optionsFor(const PublishedRobot& robot, std::vector<std::string>& log) {
  Ros2Hardware::Options options;
  options.prefix = robot.prefix();
  options.type = robot.info();
  options.log = [&log](const std::string& line) { log.push_back(line); };
  return options;
}

/// Publishes until a client has connected: its readers may come at any time.
std::unique_ptr<Ros2Hardware> connect(PublishedRobot& robot, const Ros2Hardware::Options& options) {
  std::unique_ptr<Ros2Hardware> hardware;
  std::atomic<bool> is_connected{false};
  std::jthread client([&] {
    hardware = std::make_unique<Ros2Hardware>(join(), options);
    is_connected = true;
  });
  EXPECT_TRUE(eventually([&] {
    robot.publish();
    return is_connected.load();
  }));
  client.join();
  return hardware;
}

/// Lets the robot take a step by the next command, and returns after its readings are received.
void takeStep(PublishedRobot& robot, Ros2Hardware& hardware, const std::set<std::string>& without = {}) {
  const int before = robot.received();
  std::jthread simulator([&] {
    ASSERT_TRUE(eventually([&] { return robot.received() > before; }));
    robot.step();
    robot.publish(without);
  });
  EXPECT_TRUE(hardware.nextStep());
  simulator.join();
}

TEST(Ros2Hardware, HasTheReadingsOfTheRobotNumberByNumber) {
  PublishedRobot simulated("small_maze");
  std::vector<std::string> log;
  auto options = optionsFor(simulated, log);
  options.together = std::chrono::seconds(10);
  const auto hardware = connect(simulated, options);
  ASSERT_FALSE(log.empty());
  const auto& sensors = *hardware->info().sensors;
  ASSERT_EQ(sensors.size(), simulated.info().sensors->size()) << log.back();
  Robot robot(*hardware);
  const auto controller = makeController("wander", {}, "robot");
  std::size_t ranges = 0;
  for (int i = 0; i < 40; ++i) {
    controller->step(robot);
    takeStep(simulated, *hardware);
    if (i < 2) continue;  // how often the sensors measure is not known yet, so that a reading may be of the step before
    for (std::size_t k = 0; k < sensors.size(); ++k) {
      const Measurement& read = hardware->readings().measurements[k];
      const Measurement& made = simulated.state().readings[0].measurements[k];
      ASSERT_EQ(read.index(), made.index()) << sensors[k].label;
      if (const auto* echoes = std::get_if<Echoes>(&made)) {
        const auto& received = std::get<Echoes>(read);
        ASSERT_EQ(received.size(), echoes->size());
        // Scans are counter-clockwise.
        const double first_rad = (*simulated.info().sensors)[k].beams[0].robot_from_beam.yaw;
        const bool is_clockwise = sensors[k].beams[0].robot_from_beam.yaw * first_rad < 0;
        for (std::size_t beam = 0; beam < echoes->size(); ++beam) {
          const Echo& echo = (*echoes)[is_clockwise ? echoes->size() - 1 - beam : beam];
          EXPECT_EQ(received[beam].range_m, echo.range_m) << sensors[k].label << ' ' << beam;
          ++ranges;
          // The echo of a sonar is anywhere in its cone.
          if (sensors[k].kind != SensorKind::laser || echo.range_m <= static_cast<float>(sensors[k].range_min_m))
            continue;
          EXPECT_NEAR(received[beam].point_m.x, echo.point_m.x, 1e-5) << sensors[k].label << ' ' << beam;
          EXPECT_NEAR(received[beam].point_m.y, echo.point_m.y, 1e-5);
        }
      } else if (const auto* odometry = std::get_if<Odometry>(&made)) {
        const auto& received = std::get<Odometry>(read);
        EXPECT_NEAR(received.odom_from_robot.x, odometry->odom_from_robot.x, 1e-12);
        EXPECT_NEAR(received.odom_from_robot.phi, odometry->odom_from_robot.phi, 1e-12);
        EXPECT_EQ(received.speed_mps, odometry->speed_mps);
      } else if (const auto* scalar = std::get_if<Scalar>(&made)) {
        EXPECT_NEAR(std::get<Scalar>(read).value, scalar->value, 1e-6) << sensors[k].label;
      } else {
        EXPECT_TRUE(read == made) << sensors[k].label;
      }
    }
  }
  EXPECT_GT(ranges, 1000u);
  EXPECT_GT(simulated.state().driven_m[0], 0.5);
  EXPECT_EQ(hardware->readings().time.step, 40u);
}

TEST(Ros2Hardware, LetsTheRobotStandWhileARangeSensorIsSilent) {
  PublishedRobot simulated("small_maze");
  std::vector<std::string> log;
  const auto hardware = connect(simulated, optionsFor(simulated, log));
  hardware->command({.speed_mps = 0.2});
  takeStep(simulated, *hardware);
  EXPECT_EQ(simulated.commandedSpeed(), 0.2);
  // 0.5 s without scans.
  for (int i = 0; i < 7; ++i) takeStep(simulated, *hardware, {"scan"});
  EXPECT_EQ(hardware->baseState().stop_reason, "the readings of " + simulated.prefix() + "/scan are old");
  EXPECT_EQ(simulated.commandedSpeed(), 0);
  // Usually in the next step; a scan that arrives 20 ms after the odometry belongs to the step after it.
  EXPECT_TRUE(eventually([&] {
    takeStep(simulated, *hardware);
    return hardware->baseState().stop_reason.empty();
  }));
  takeStep(simulated, *hardware);
  EXPECT_EQ(simulated.commandedSpeed(), 0.2);
}

TEST(Ros2Hardware, StopsTheRobotWhoseScansHaveAnotherNumberOfRanges) {
  PublishedRobot simulated("small_maze");
  std::vector<std::string> log;
  const auto hardware = connect(simulated, optionsFor(simulated, log));
  hardware->command({.speed_mps = 0.2});
  takeStep(simulated, *hardware);
  const auto another = join();
  const auto other =
      another->write({simulated.prefix() + "/scan", &ros::typeOf<ros::LaserScan>(), TopicDelivery::sensor});
  ASSERT_TRUE(eventually([&] { return other->readers() > 0; }));
  for (int i = 0; i < 8; ++i) {
    ros::LaserScan scan;
    scan.header.stamp = timeOf(nanosecondsOf(simulated.state().time.seconds() + 0.1));
    scan.ranges.resize(7);
    std::vector<std::uint8_t> bytes;
    ros::encode(scan, bytes);
    other->write(std::move(bytes));
    takeStep(simulated, *hardware, {"scan"});
  }
  EXPECT_EQ(hardware->baseState().stop_reason, "the readings of " + simulated.prefix() + "/scan are old");
  const auto is_about_ranges = [](const std::string& line) {
    return line.find("/scan cannot be read: a scan of 7 ranges, after one of ") != std::string::npos;
  };
  EXPECT_EQ(std::count_if(log.begin(), log.end(), is_about_ranges), 1);
}

TEST(Ros2Hardware, LimitsCommandsAndSendsZerosWithoutOdometryAndAtTheEnd) {
  PublishedRobot simulated("small_maze");
  std::vector<std::string> log;
  auto options = optionsFor(simulated, log);
  std::atomic<bool> is_interrupted = false;
  options.interrupted = [&] { return is_interrupted.load(); };
  auto hardware = connect(simulated, options);
  hardware->command({.speed_mps = 99, .turn_radps = -99});
  takeStep(simulated, *hardware);
  EXPECT_EQ(simulated.commandedSpeed(), simulated.info().type->limits.speed_max_mps);
  EXPECT_EQ(simulated.commandedTurn(), -simulated.info().type->limits.turn_max_radps);
  // Without odometry for a second.
  std::jthread silent([&] {
    EXPECT_TRUE(eventually([&] { return simulated.commandedSpeed() == 0; }));
    is_interrupted = true;
  });
  EXPECT_FALSE(hardware->nextStep());
  silent.join();
  EXPECT_EQ(log.back(), "the robot has sent no odometry for 1 s");
  is_interrupted = false;
  hardware->command({.speed_mps = 0.1});
  takeStep(simulated, *hardware);
  takeStep(simulated, *hardware);
  EXPECT_EQ(simulated.commandedSpeed(), 0.1);
  hardware.reset();
  EXPECT_TRUE(eventually([&] { return simulated.commandedSpeed() == 0; }));
}

TEST(Ros2Hardware, RefusesNamesOfTopicsThatTheRobotTypeDoesNotHave) {
  PublishedRobot simulated("small_maze");
  std::vector<std::string> log;
  auto options = optionsFor(simulated, log);
  options.topics = {{"scann", "/base_scan"}};
  EXPECT_THROW(Ros2Hardware(join(), options), ConfigError);
}

}  // namespace
}  // namespace robosim
