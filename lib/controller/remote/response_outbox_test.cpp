#include "remote/response_outbox.h"

#include <gtest/gtest.h>

#include "control/testing/fake_hardware.h"

namespace robosim {
namespace {

class IdleController : public Controller {
 public:
  void step(Robot&) override {}
};

/// A robot with a camera in slot 4, besides odometry, sonar, laser and heat.
struct ResponseOutboxTest : testing::Test {
  FakeHardware hardware;
  RemoteControlRobot robot{withCamera(hardware), std::make_unique<IdleController>(), {}};
  PortRobot port_robot{robot};
  ResponseOutbox outbox{port_robot, welcome()};

  static FakeHardware& withCamera(FakeHardware& hardware) {
    auto sensors = *hardware.info().sensors;
    sensors.emplace_back();
    sensors.back().kind = SensorKind::camera;
    sensors.back().label = "camera";
    hardware.mutableInfo().sensors = std::make_shared<std::vector<SensorInfo>>(sensors);
    hardware.mutableReadings().measurements.emplace_back(Image{});
    return hardware;
  }
  static RobotsWelcome welcome() {
    RobotsWelcome welcome;
    welcome.world = "maze";
    return welcome;
  }

  /// The next message.
  v1::ControlResponse take() {
    v1::ControlResponse message;
    outbox.takeNext(message);
    return message;
  }
  void step(const std::string& jpeg = "") {
    std::get<Image>(hardware.mutableReadings().measurements[4]).jpeg = jpeg;
    port_robot.keepPictures();
    outbox.addReadings(true);
    hardware.advance();
  }
};

TEST_F(ResponseOutboxTest, TheFirstStateContainsTheWelcome) {
  EXPECT_TRUE(outbox.isEmpty());
  outbox.addState(true);
  outbox.addState(false);
  const auto first = take();
  EXPECT_EQ(first.welcome().world(), "maze");
  EXPECT_FALSE(first.state().is_yours()) << "the newest state";
  EXPECT_TRUE(outbox.isEmpty());
  outbox.addState(true);
  EXPECT_FALSE(take().has_welcome());
}

// The newest state replaces one that was not sent. That the robot has stopped follows from `stops` nevertheless.
TEST_F(ResponseOutboxTest, CountsAStopWhoseReasonANewerStateHasCleared) {
  const auto drive = driveOrder(0.5);
  const auto order = [&](const v1::ControlRequest& next) {
    robot.obey(next);
    robot.step();
    outbox.addState(true);
  };
  robot.take("Anna", false);
  order(drive);
  order(stopOrder("Anna's page is hidden"));
  order(drive);
  const auto message = take();
  EXPECT_EQ(message.state().why_stopped(), "");
  EXPECT_EQ(message.state().speed_mps(), 0.5);
  EXPECT_EQ(message.state().stops(), 1u);
}

TEST_F(ResponseOutboxTest, ContainsReadingsOnlyOnRequestAndOnce) {
  step();
  EXPECT_TRUE(outbox.isEmpty());
  EXPECT_TRUE(outbox.request(OrderType::req_heat));
  hardware.setHeat(7);
  step();
  const auto message = take();
  EXPECT_EQ(message.reading().kind(), "heat");
  EXPECT_EQ(message.reading().sensor(), 3u);
  EXPECT_EQ(message.reading().measurement().step(), message.reading().step());
  step();
  EXPECT_TRUE(outbox.isEmpty());
}

TEST_F(ResponseOutboxTest, ReplacesReadingsThatWereNotSentByNewerOnes) {
  outbox.requestAll();
  for (int i = 0; i < 100; ++i) step();
  EXPECT_EQ(take().all().step(), 99u);
  EXPECT_TRUE(outbox.isEmpty());
}

TEST_F(ResponseOutboxTest, SendsTheStateFirst) {
  outbox.requestAll();
  outbox.request(OrderType::req_sonar);
  step();
  outbox.addState(true);
  EXPECT_TRUE(take().has_welcome());
  EXPECT_EQ(take().reading().kind(), "sonar");
  EXPECT_TRUE(take().has_all());
}

TEST_F(ResponseOutboxTest, SendsEachPictureOnceEvenIfItsStepWasMissed) {
  const auto picture_in = [](const v1::ControlResponse& message) {
    return message.all().readings().measurements(4).jpeg();
  };
  step("picture");
  step();
  outbox.requestAll();
  step();
  const auto message = take();
  EXPECT_EQ(picture_in(message), "picture");
  EXPECT_EQ(message.all().readings().measurements(4).step(), 0u);
  outbox.requestAll();
  step();
  EXPECT_EQ(picture_in(take()), "");
}

TEST_F(ResponseOutboxTest, SendsAFileOfAnExactPicture) {
  RawPicture raw;
  raw.width_px = raw.height_px = 1;
  raw.range_max_m = 1;
  raw.rgb = {200, 100, 50};
  hardware.mutableReadings().measurements[4] = Image{"", std::make_shared<const RawPicture>(raw)};
  port_robot.keepPictures();
  outbox.requestAll();
  step();
  const auto message = take();
  const v1::Measurement& sent = message.all().readings().measurements(4);
  EXPECT_TRUE(sent.raw_picture().empty());
  EXPECT_EQ(sent.jpeg().substr(0, 2), "\xFF\xD8");
}

TEST_F(ResponseOutboxTest, ForwardsAReceivedMessageAsItWouldEncodeItsReadings) {
  ResponseOutbox encoding{port_robot, welcome()};
  hardware.setHeat(7);
  hardware.setLaserRange(2);
  hardware.mutableReadings().inbox.edit() = {{"other", hardware.info().name, "text"}};
  for (const char* jpeg : {"picture", "", "another"}) {
    std::get<Image>(hardware.mutableReadings().measurements[4]).jpeg = jpeg;
    port_robot.keepPictures();
    v1::RobotReadings received;
    encode(hardware.readings(), received);
    for (ResponseOutbox* one : {&outbox, &encoding}) {
      one->requestAll();
      one->request(OrderType::req_laser);
      one->addReadings(true, one == &outbox ? &received : nullptr);
    }
    while (!outbox.isEmpty()) {
      v1::ControlResponse message;
      encoding.takeNext(message);
      EXPECT_EQ(take().SerializeAsString(), message.SerializeAsString()) << message.DebugString();
    }
    EXPECT_TRUE(encoding.isEmpty());
    hardware.advance();
  }
}

TEST_F(ResponseOutboxTest, MarksAMeasurementAsNewInTheFirstOfItsMessages) {
  outbox.request(OrderType::req_heat);
  outbox.requestAll();
  step();
  EXPECT_TRUE(take().reading().measurement().is_new());
  const auto of_same_step = take();
  EXPECT_EQ(of_same_step.all().readings().measurements(3).step(), 0u);
  EXPECT_FALSE(of_same_step.all().readings().measurements(3).is_new()) << "heat, received before";
  EXPECT_TRUE(of_same_step.all().readings().measurements(0).is_new());
  outbox.requestAll();
  step();
  EXPECT_TRUE(take().all().readings().measurements(3).is_new()) << "the next step";
}

TEST_F(ResponseOutboxTest, AcceptsOnlyRequests) {
  EXPECT_TRUE(outbox.request(OrderType::req_laser));
  EXPECT_FALSE(outbox.request(OrderType::stop));
  EXPECT_FALSE(outbox.request(OrderType::drive));
}

}  // namespace
}  // namespace robosim
