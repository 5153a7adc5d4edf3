// A robot's remote port, and the link that a remote control has with it, over real connections.
#include "remote/remote_port.h"

#include <gtest/gtest.h>

#include "remote/robot_link.h"
#include "remote/testing/test_robot.h"
#include "robosim/v1/remote_control.grpc.pb.h"

namespace robosim {
namespace {

std::unique_ptr<RobotLink> linkTo(const TestRobot& robot, const std::string& token = "",
                                  const std::string& name = "Pioneer1") {
  ConnectOptions connect_options;
  connect_options.address = robot.address();
  connect_options.token = token;
  return std::make_unique<RobotLink>(name, connect_options, [] { testEvents().notify(); });
}

struct RemotePortTest : testing::Test {
  TestRobot robot{"Pioneer1"};
  std::unique_ptr<RobotLink> anna = linkTo(robot);

  void wait(const std::function<bool()>& until, const CallSite& place = CallSite::here()) {
    waitUntil(
        until, [&] { robot.step(); }, place);
  }
  void waitUp(RobotLink& link) {
    wait([&] { return link.news().is_up; });
  }
  void connect(RobotLink& link, const std::string& driver, bool autonomous = false) {
    link.claim(driver, autonomous);
    link.connect();
    waitUp(link);
  }
  static void drive(RobotLink& link, double speed_mps) { link.send(driveOrder(speed_mps)); }
  double commandedSpeed() const { return robot.hardware->lastCommand().speed_mps; }
};

TEST_F(RemotePortTest, DescribesTheRobotToARemoteControl) {
  connect(*anna, "Anna");
  const RobotNews news = anna->news();
  EXPECT_EQ(news.world, "maze");
  EXPECT_EQ(news.period_s, 0.1);
  EXPECT_EQ(news.info->name, "Pioneer1");
  EXPECT_EQ(news.info->sensors->size(), 4u);
  EXPECT_TRUE(news.state.is_yours());
  EXPECT_EQ(news.state.driver(), "Anna");
  EXPECT_FALSE(news.state.autonomous());
}

TEST_F(RemotePortTest, AStopAndASpeedOfZeroAreNotSuperseded) {
  connect(*anna, "Anna");
  double turn_radps = 0;
  for (const v1::ControlRequest& first : {stopOrder(), driveOrder(0)}) {
    drive(*anna, 0.5);
    wait([&] { return commandedSpeed() == 0.5; });
    anna->send(first);
    turn_radps += 0.5;
    for (int i = 0; i < 100; ++i) anna->send(driveOrder({}, turn_radps));
    wait([&] { return robot.hardware->lastCommand().turn_radps == turn_radps; });
    EXPECT_EQ(commandedSpeed(), 0);
  }
}

TEST_F(RemotePortTest, ADriverSteersAndEnablesTheController) {
  connect(*anna, "Anna");
  drive(*anna, 0.5);
  wait([&] { return commandedSpeed() == 0.5; });
  anna->send(modeOrder(true));
  wait([&] { return robot.hardware->lastCommand() == Command{.turn_radps = 1}; });
  wait([&] { return anna->news().state.autonomous(); });
}

TEST_F(RemotePortTest, AClaimDiscardsOrdersThatWait) {
  connect(*anna, "Anna");
  drive(*anna, 0.25);
  drive(*anna, 0.5);  // waits until the first is sent
  anna->claim("Ben", false);
  wait([&] { return anna->news().state.driver() == "Ben"; });
  anna->send(makeOrder(OrderType::req_heat));  // sent after all orders that steer
  wait([&] { return anna->news().answers[0] != nullptr; });
  robot.step();
  EXPECT_EQ(commandedSpeed(), 0);
}

TEST_F(RemotePortTest, StopsTheRobotWhenTheDriverDisconnectsAndLogsTheReason) {
  connect(*anna, "Anna");
  drive(*anna, 0.5);
  wait([&] { return commandedSpeed() == 0.5; });
  anna.reset();
  waitUntil([&] { return robot.log().find("Pioneer1 stops") != std::string::npos; });
  robot.step();
  EXPECT_EQ(commandedSpeed(), 0);
  EXPECT_NE(robot.log().find("Pioneer1 stops: its remote control has disconnected"), std::string::npos) << robot.log();
}

TEST_F(RemotePortTest, StopsTheRobotAfterTheDeadManTimeoutAndReportsTheReason) {
  connect(*anna, "Anna");
  anna->setLive(true);
  drive(*anna, 0.5);
  wait([&] { return commandedSpeed() == 0.5; });
  // Requests of the link do not reset the dead-man timeout.
  wait([&] {
    const auto last = anna->news().update;
    wait([&] { return anna->news().update != last; });
    return commandedSpeed() == 0;
  });
  wait([&] { return anna->news().state.why_stopped() == "no message from Anna for 0.5 s"; });
}

TEST_F(RemotePortTest, ASecondDriverWatchesAndSeesTheDriversName) {
  connect(*anna, "Anna");
  const auto ben = linkTo(robot);
  connect(*ben, "Ben");
  EXPECT_FALSE(ben->news().state.is_yours());
  EXPECT_EQ(ben->news().state.driver(), "Anna");
  drive(*ben, 1);
  drive(*anna, 0.25);
  wait([&] { return commandedSpeed() == 0.25; });
  ben->setLive(true);
  wait([&] { return ben->news().update != nullptr; });

  anna.reset();
  wait([&] { return ben->news().state.driver().empty(); });
  ben->claim("Ben", false);
  wait([&] { return ben->news().state.is_yours(); });
  drive(*ben, 1);
  wait([&] { return commandedSpeed() == 1; });
}

TEST_F(RemotePortTest, SendsReadingsToSubscribers) {
  connect(*anna, "Anna");
  EXPECT_EQ(anna->news().update, nullptr);
  anna->setLive(true);
  robot.hardware->setHeat(7);
  for (int i = 0; i < 3; ++i) {
    const auto previous = anna->news().update;
    wait([&] { return anna->news().update != previous; });
  }
  EXPECT_EQ(std::get<Scalar>(anna->news().update->readings.measurements[3]).value, 7);
  const auto last = anna->news().update;
  anna->setLive(false);
  wait([&] { return anna->news().update != last; });  // requested when the previous one was received
  const auto latest = anna->news().update;
  for (int i = 0; i < 10; ++i) robot.step();
  anna->send(makeOrder(OrderType::req_sonar));
  wait([&] { return anna->news().answers[2] != nullptr; });
  EXPECT_EQ(anna->news().update, latest);
}

TEST_F(RemotePortTest, AnswersARequestWithTheNextReading) {
  connect(*anna, "Anna");
  robot.hardware->setHeat(3);
  robot.hardware->setLaserRange(2);
  for (const auto type : {OrderType::req_heat, OrderType::req_laser, OrderType::req_sonar}) anna->send(makeOrder(type));
  wait([&] { return anna->news().answers[0] && anna->news().answers[1] && anna->news().answers[2]; });
  EXPECT_EQ(std::get<Scalar>(anna->news().answers[0]->measurement).value, 3);
  EXPECT_EQ(std::get<Echoes>(anna->news().answers[1]->measurement)[0].range_m, 2);
  EXPECT_EQ(std::get<Echoes>(anna->news().answers[2]->measurement).size(), 16u);
  EXPECT_EQ(anna->news().answers[2]->sensor, 1u);
}

TEST_F(RemotePortTest, ReportsAMissingSensor) {
  auto& info = robot.hardware->mutableInfo();
  info.sensors = std::make_shared<std::vector<SensorInfo>>(1, (*info.sensors)[0]);
  robot.hardware->mutableReadings().measurements.resize(1);
  connect(*anna, "Anna");
  anna->send(makeOrder(OrderType::req_heat));
  wait([&] { return anna->news().answers[0] != nullptr; });
  EXPECT_FALSE(anna->news().answers[0]->has_sensor);
}

TEST_F(RemotePortTest, SendsAPictureToARemoteControlThatMissedItsStep) {
  auto sensors = *robot.hardware->info().sensors;
  sensors.emplace_back();
  sensors.back().kind = SensorKind::camera;
  sensors.back().label = "camera";
  sensors.back().beams.emplace_back();
  sensors.back().camera = {.width_px = 320, .height_px = 240, .field_of_view_rad = 1, .rate_hz = 10};
  TestRobot seeing("Pioneer2");
  seeing.hardware->mutableInfo().sensors = std::make_shared<std::vector<SensorInfo>>(sensors);
  auto& readings = seeing.hardware->mutableReadings();
  readings.measurements.emplace_back(Image{});
  seeing.close();
  seeing.reopen();
  auto ben = linkTo(seeing, "", "Pioneer2");
  ben->claim("Ben", true);
  ben->connect();
  waitUntil([&] { return ben->news().is_up; });

  ASSERT_EQ(readings.time.step, 0u) << "the first picture of the run";
  const std::string jpeg = "\xFF\xD8 a picture \xFF\xD9";
  std::get<Image>(readings.measurements[4]).jpeg = jpeg;
  const auto step = readings.time.step;
  seeing.step();
  std::get<Image>(readings.measurements[4]).jpeg.clear();
  for (int i = 0; i < 5; ++i) seeing.step();  // steps without a picture, and none is requested yet
  ben->setLive(true);
  waitUntil([&] { return ben->news().picture != nullptr; }, [&] { seeing.step(); });
  EXPECT_EQ(ben->news().picture->jpeg, jpeg);
  EXPECT_EQ(ben->news().picture->step, step);
  const auto first = ben->news().picture;
  const auto update = ben->news().update;
  waitUntil([&] { return ben->news().update != update; }, [&] { seeing.step(); });
  EXPECT_EQ(ben->news().picture, first) << "it comes once";
}

TEST_F(RemotePortTest, IsWatchedFromARequestOfAllReadingsUntilSomeStepsAfterTheLast) {
  connect(*anna, "Anna");
  anna->send(makeOrder(OrderType::req_sonar));
  wait([&] { return anna->news().answers[2] != nullptr; });
  EXPECT_FALSE(robot.isWatched()) << "the sonars are no picture";
  anna->setLive(true);
  waitUntil([&] { return robot.isWatched(); }, [&] { robot.step(); });
  anna->setLive(false);
  waitUntil([&] { return !robot.isWatched(); }, [&] { robot.step(); });
}

TEST_F(RemotePortTest, ReportsTheWinnerAndTheEndOfTheRunToAll) {
  connect(*anna, "Anna");
  const auto ben = linkTo(robot);
  connect(*ben, "Ben");
  robot.hardware->mutableReadings().winner = "Pioneer1";
  robot.step();
  robot.endRun();
  for (RobotLink* link : {anna.get(), ben.get()}) {
    waitUntil([&] { return !link->isCalling(); });
    EXPECT_EQ(link->news().state.winner(), "Pioneer1");
    EXPECT_EQ(link->news().problem, "the run is over");
    EXPECT_TRUE(link->news().is_over);
  }
  robot.close();
  anna->connect();
  waitUntil([&] { return !anna->isCalling(); });
  EXPECT_TRUE(anna->news().is_over) << "that nothing answers any more is no failure";
  EXPECT_EQ(anna->news().problem, "the run is over");
}

TEST_F(RemotePortTest, ReportsAWrongOrUnreachableRobot) {
  const auto wrong = linkTo(robot, "", "Scout1");
  wrong->claim("Anna", false);
  wrong->connect();
  waitUntil([&] { return !wrong->isCalling(); });
  EXPECT_EQ(wrong->news().problem,
            "this port serves no robot 'Scout1', only Pioneer1; correct its port in the robot list");
  EXPECT_TRUE(wrong->news().was_refused);

  robot.close();
  anna->claim("Anna", false);
  anna->connect();
  waitUntil([&] { return !anna->isCalling(); });
  EXPECT_EQ(anna->news().problem,
            "no robot answers at " + robot.address() + "; is 'robosim robot Pioneer1 --remote-port …' running?");
  EXPECT_FALSE(anna->news().was_refused);
  EXPECT_FALSE(anna->news().is_over);
}

/// Sends one message, which RobotLink might never send. @return the status of the call
grpc::Status statusAfter(const TestRobot& robot, const v1::ControlRequest& message) {
  ConnectOptions connect_options;
  connect_options.address = robot.address();
  const auto stub = v1::RemoteControl::NewStub(connect(connect_options));
  grpc::ClientContext context;
  const auto stream = stub->Control(&context);
  stream->Write(message);
  v1::ControlResponse in;
  while (stream->Read(&in)) {
  }
  return stream->Finish();
}

TEST_F(RemotePortTest, DisconnectsARemoteControlForAnInvalidMessageAndNoOther) {
  connect(*anna, "Anna");
  v1::ControlRequest message;
  message.mutable_drive();
  EXPECT_EQ(statusAfter(robot, message).error_message(), "the first message of a remote control must be its INIT");
  message.mutable_steer();  // of an unspecified type
  EXPECT_EQ(statusAfter(robot, message).error_code(), grpc::StatusCode::INVALID_ARGUMENT);
  message.mutable_init()->set_protocol(9);
  EXPECT_EQ(statusAfter(robot, message).error_code(), grpc::StatusCode::FAILED_PRECONDITION);
  drive(*anna, 0.5);
  wait([&] { return commandedSpeed() == 0.5; });
}

TEST(RemotePortAccess, PermitsEachTokenWhatItsRolePermits) {
  const std::string viewer = "viewer-0123456789abcdef", driver = "driver-0123456789abcdef",
                    other = "others-0123456789abcdef";
  TestRobot robot("Pioneer1",
                  Access::parse(viewer + " viewer\n" + driver + " robot Pioneer1\n" + other + " robot X\n", "tokens"));
  const auto news_of = [&](const std::string& token) {
    const auto link = linkTo(robot, token);
    link->claim("Anna", false);
    link->connect();
    waitUntil([&] { return link->news().is_up || !link->isCalling(); }, [&] { robot.step(); });
    return link->news();
  };
  EXPECT_TRUE(news_of(driver).state.is_yours());
  waitUntil([&] { return robot.robot.state().driver().empty(); }, [&] { robot.step(); });
  EXPECT_EQ(news_of(viewer).problem, "");
  EXPECT_FALSE(news_of(viewer).state.is_yours()) << "may watch only";
  EXPECT_EQ(news_of(other).problem, "the token is not for robot 'Pioneer1' but for X; use another");
  EXPECT_NE(news_of("").problem.find("requires a token"), std::string::npos);
  EXPECT_NE(news_of("wrong-0123456789abcdef").problem.find("the token is unknown"), std::string::npos);
  EXPECT_EQ(robot.log().find("0123456789abcdef"), std::string::npos) << "no log contains a token";
}

TEST(RemotePortAccess, OfAViewersOrdersOnlyThoseOfTheRightToLookHaveAnEffect) {
  const std::string viewer = "viewer-0123456789abcdef";
  TestRobot robot("Pioneer1", Access::parse(viewer + " viewer\n", "tokens"));
  const auto link = linkTo(robot, viewer);
  link->claim("Anna", false);
  link->connect();
  waitUntil([&] { return link->news().is_up; }, [&] { robot.step(); });
  for (const OrderRow& row : kOrders) {
    const auto before = link->news().answers;
    link->send(row.rule == OrderRule::set ? driveOrder(0.5) : makeOrder(row.type));
    link->send(makeOrder(OrderType::req_sonar));  // whose answer follows
    const std::size_t answer = readingIndex(row.right == Right::look ? row.type : OrderType::req_sonar);
    waitUntil([&] { return link->news().answers[answer] != before[answer]; }, [&] { robot.step(); });
    EXPECT_EQ(robot.hardware->lastCommand(), (Command{.turn_radps = 1})) << row.name;
    EXPECT_TRUE(robot.robot.state().autonomous()) << row.name;
    EXPECT_EQ(robot.hardware->win_checks, 0) << row.name;
  }
}

TEST(RemotePortDeadline, EndsACallWithoutAnInit) {
  FakeHardware hardware;
  RemoteControlRobot robot(hardware, std::make_unique<Spinner>(), {});
  std::mutex mutex;
  std::string log;
  RemotePort::Options options;
  options.init_deadline = std::chrono::milliseconds(50);
  options.log = [&](const std::string& line) {
    const std::lock_guard lock(mutex);
    log += line + "\n";
  };
  {
    const RemotePort port(options, {"maze", 7, 0.1}, {&robot});
    grpc::ClientContext context;
    const auto stub = v1::RemoteControl::NewStub(connect({.address = "127.0.0.1:" + std::to_string(port.port())}));
    const grpc::Status status = stub->Control(&context)->Finish();
    EXPECT_EQ(status.error_code(), grpc::StatusCode::DEADLINE_EXCEEDED);
    EXPECT_EQ(status.error_message(), "no INIT within 50 ms of the call; send it at once, and call again");
  }
  EXPECT_NE(log.find("disconnected: no INIT within 50 ms"), std::string::npos) << log;
}

}  // namespace
}  // namespace robosim
