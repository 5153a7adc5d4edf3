#include "serving/foxglove_commands.h"

#include <chrono>
#include <limits>

#include <gtest/gtest.h>

#include "ros/cdr.h"
#include "ros/messages.h"

namespace robosim {
namespace {

using namespace std::chrono_literals;

const char* const kTokens =
    "viewer-0123456789abcdef viewer\n"
    "only-one-0123456789abcdef robot Pioneer1\n"
    "operator-0123456789abcdef operator name=anna\n";

/// Two robots, whose controllers do nothing.
struct FoxgloveCommandsTest : testing::Test {
  RunOptions options = [] {
    RunOptions made;
    made.controller = "still";
    return made;
  }();
  LocalRun run{loadWorldToRun(ROBOSIM_SOURCE_DIR "/worlds/small_maze.xml", "still"), options};
  RobotDrivers::Clock::time_point now;
  std::string log;
  Access access = Access::parse(kTokens, "tokens");
  RobotDrivers drivers{access, [this](const std::string& line) { log += line + "\n"; }, [this] { return now; }};
  FoxgloveCommands commands{drivers};
  const foxglove::ClientChannel channel{1, "/Pioneer1/cmd_vel", "cdr", "geometry_msgs/msg/Twist"};

  FoxgloveCommandsTest() { drivers.begin(run, {"", ""}); }

  foxglove::Client client(PageId id, const std::string& token) const {
    return {id, "192.0.2.7", access.authenticate(token, "192.0.2.7").identity};
  }
  foxglove::Client anna(PageId id = 1) const { return client(id, "operator-0123456789abcdef"); }
  template <ros::Message M>
  std::string publish(const foxglove::Client& by, const M& message) {
    std::vector<std::uint8_t> bytes;
    ros::encode(message, bytes);
    const foxglove::ClientChannel of_type{1, channel.topic, "cdr", M::kType};
    return commands.published(by, {of_type, {reinterpret_cast<const char*>(bytes.data()), bytes.size()}});
  }
  std::string drive(const foxglove::Client& by, double speed_mps) {
    return publish(by, ros::Twist{{speed_mps, 0, 0}, {}});
  }
  /// The command of Pioneer1 for the next step.
  const Command& command() {
    run.step();
    return run.environment().state().commands[0];
  }
};

TEST_F(FoxgloveCommandsTest, DrivesARobotInsteadOfItsController) {
  EXPECT_EQ(commands.advertised(anna(), channel), "");
  EXPECT_EQ(drive(anna(), 0.2), "");
  EXPECT_EQ(command().speed_mps, 0.2);
  EXPECT_TRUE(command().by_driver);
  EXPECT_EQ(run.environment().state().commands[1].speed_mps, 0);
  EXPECT_NE(log.find("anna (192.0.2.7): drive Pioneer1"), std::string::npos) << log;
}

TEST_F(FoxgloveCommandsTest, ReadsStampedAndJsonMessages) {
  EXPECT_EQ(publish(anna(), ros::TwistStamped{{{}, "Pioneer1/base_link"}, {{0.1, 0, 0}, {0, 0, 0.5}}}), "");
  EXPECT_EQ(command().speed_mps, 0.1);
  EXPECT_EQ(command().turn_radps, 0.5);
  const foxglove::ClientChannel as_json{1, channel.topic, "json", "geometry_msgs/Twist"};
  EXPECT_EQ(commands.published(anna(), {as_json, R"({"linear":{"x":0.3}})"}), "");
  EXPECT_EQ(command().speed_mps, 0.3);
  EXPECT_EQ(commands.published(anna(), {as_json, "[]"}), "the message is no JSON object");
  EXPECT_EQ(commands.published(anna(), {as_json, R"({"linear":{"x":"a"}})"}), "linear.x is no number");
  EXPECT_EQ(commands.published(anna(), {as_json, R"({"linear":1})"}), "linear is no object");
  const foxglove::ClientChannel stamped{1, channel.topic, "json", "geometry_msgs/msg/TwistStamped"};
  EXPECT_EQ(commands.published(anna(), {stamped, R"({"twist":1})"}), "twist is no object");
  EXPECT_EQ(commands.published(anna(), {stamped, R"({"twist":{"angular":{"z":0.5}}})"}), "");
}

TEST_F(FoxgloveCommandsTest, StopsARobotWithoutMessagesOfItsDriver) {
  drive(anna(), 0.2);
  now += 500ms;
  EXPECT_EQ(command().speed_mps, 0.2);
  now += 1ms;
  EXPECT_EQ(command().speed_mps, 0);
  EXPECT_NE(log.find("Pioneer1 stops: no message from anna by Foxglove for 0.5 s"), std::string::npos) << log;
}

TEST_F(FoxgloveCommandsTest, StopsARobotWhoseDriverHasLeft) {
  drive(anna(), 0.2);
  EXPECT_EQ(command().speed_mps, 0.2);
  commands.withdrawn(anna(2), channel);
  EXPECT_EQ(command().speed_mps, 0.2) << "of another client";
  commands.withdrawn(anna(), channel);
  EXPECT_EQ(command().speed_mps, 0);
  EXPECT_FALSE(drivers.autonomous()[0].second);
}

TEST_F(FoxgloveCommandsTest, DrivesOnWhenARobotIsAddedAndDrivesThatToo) {
  drive(anna(), 0.2);
  ASSERT_EQ(run.environment().apply({"test", AddRobot{"New", "scout", {0, 0, 0}}}), "");
  run.followAdditions();
  drivers.addRobots(run, {"", "", ""});
  EXPECT_EQ(command().speed_mps, 0.2) << "the driver stays";
  EXPECT_EQ(drive(anna(), 0.1), "");
  EXPECT_EQ(command().speed_mps, 0.1);
  EXPECT_EQ(drivers.setAutonomous(driverOf(anna()), "/Pioneer1/autonomous", true), "");
  EXPECT_FALSE(command().by_driver) << "the controller continues";
  const foxglove::ClientChannel of_new{2, "/New/cmd_vel", "json", "geometry_msgs/Twist"};
  EXPECT_EQ(commands.published(anna(), {of_new, R"({"linear":{"x":0.3}})"}), "");
  run.step();
  EXPECT_EQ(run.environment().state().commands[2].speed_mps, 0.3);
}

TEST_F(FoxgloveCommandsTest, LimitsTheSpeedToThatOfTheRobot) {
  const double speed_max_mps = run.environment().fleet().robots[0].info.type->limits.speed_max_mps;
  drive(anna(), 1e9);
  EXPECT_EQ(command().speed_mps, speed_max_mps);
  EXPECT_EQ(drive(anna(), std::numeric_limits<double>::infinity()), "speeds must be finite");
  EXPECT_EQ(command().speed_mps, speed_max_mps) << "an invalid message has no effect";
}

TEST_F(FoxgloveCommandsTest, HasOneDriverForARobotUntilItIsSilent) {
  drive(anna(1), 0.2);
  EXPECT_EQ(drive(anna(2), -0.2), "Pioneer1 is driven by another client, anna by Foxglove at 192.0.2.7");
  EXPECT_EQ(command().speed_mps, 0.2);
  now += 501ms;
  EXPECT_EQ(drive(anna(2), -0.2), "");
  command();  // the step in which the robot begins to stop
  EXPECT_NE(drive(anna(1), 0.2), "");
}

TEST_F(FoxgloveCommandsTest, RequiresATokenForTheRobot) {
  EXPECT_NE(commands.advertised(client(3, "viewer-0123456789abcdef"), channel), "");
  EXPECT_NE(drive(client(3, "viewer-0123456789abcdef"), 0.2), "");
  EXPECT_EQ(command().speed_mps, 0);
  const auto only_one = client(4, "only-one-0123456789abcdef");
  const foxglove::ClientChannel of_scout{1, "/Scout1/cmd_vel", "cdr", "geometry_msgs/msg/Twist"};
  EXPECT_EQ(commands.advertised(only_one, channel), "");
  EXPECT_NE(commands.advertised(only_one, of_scout), "");
  EXPECT_EQ(drivers.setAutonomous(driverOf(only_one), "/Pioneer1/autonomous", false), "");
  EXPECT_NE(drivers.setAutonomous(driverOf(only_one), "/Scout1/autonomous", false), "");
}

TEST_F(FoxgloveCommandsTest, ReturnsARobotToItsController) {
  drive(anna(), 0.2);
  EXPECT_EQ(drivers.autonomous()[0], (std::pair<std::string, bool>{"/Pioneer1/autonomous", false}));
  EXPECT_EQ(drivers.setAutonomous(driverOf(anna()), "/Pioneer1/autonomous", true), "");
  EXPECT_TRUE(drivers.autonomous()[0].second);
  EXPECT_FALSE(command().by_driver);
  EXPECT_EQ(drive(anna(2), 0.1), "") << "without a driver, any client may drive";
}

TEST_F(FoxgloveCommandsTest, RefusesWhatIsNoCommandOfARobot) {
  const auto why = [&](const std::string& topic, const std::string& encoding, const std::string& schema) {
    return commands.advertised(anna(), {1, topic, encoding, schema});
  };
  EXPECT_EQ(why("/Pioneer9/cmd_vel", "cdr", "geometry_msgs/msg/Twist"), "no robot has this topic");
  EXPECT_EQ(why("/Pioneer1/cmd_vel", "ros1", "geometry_msgs/msg/Twist"), "the encoding must be cdr or json");
  EXPECT_EQ(
      why("/Pioneer1/cmd_vel", "cdr", "std_msgs/msg/String"),
      "a message of the type std_msgs/msg/String; only geometry_msgs/msg/Twist and geometry_msgs/msg/TwistStamped "
      "on /<robot>/cmd_vel have an effect");
}

TEST(FoxgloveCommandsOfOtherProcesses, StatesWhyARobotCannotBeDriven) {
  RunOptions options;
  options.controller = "still";
  LocalRun run(loadWorldToRun(ROBOSIM_SOURCE_DIR "/worlds/small_maze.xml", "still"), options, {1, 0});
  RobotDrivers drivers({}, [](const std::string&) {});
  FoxgloveCommands commands(drivers);
  drivers.begin(run, {"another process drives this robot", ""});
  const foxglove::Client client{1, "192.0.2.7", {}};
  EXPECT_EQ(commands.advertised(client, {1, "/Pioneer1/cmd_vel", "cdr", "geometry_msgs/msg/Twist"}),
            "another process drives this robot");
  EXPECT_EQ(commands.advertised(client, {1, "/Scout1/cmd_vel", "cdr", "geometry_msgs/msg/Twist"}), "");
  EXPECT_EQ(drivers.autonomous().size(), 1u);
}

}  // namespace
}  // namespace robosim
