// The simulated controller board of an ARCOS robot, driven by packets.
#include <cmath>

#include <gtest/gtest.h>

#include "arcos/protocol/bytes.h"
#include "arcos/protocol/command.h"
#include "arcos/protocol/config_packet.h"
#include "arcos/protocol/gyro_packet.h"
#include "arcos/protocol/laser_packets.h"
#include "arcos/protocol/simulator_packets.h"
#include "arcos/protocol/sip.h"
#include "arcos/protocol/testing/hex.h"
#include "base/angle_units.h"
#include "tests/scenarios/simulated_arcos_robot.h"

namespace robosim {
namespace {

namespace command = arcos::command;
using arcos::encodeCommand;
using arcos::Sip;

/// A program that sends commands and keeps what the robot answers.
struct BoardProgram {
  explicit BoardProgram(const std::string& type = "p3dx", const mrpt::math::TPose2D& start = {}, double room_m = 0)
      : robot(type, start, room_m) {
    send(encodeCommand(command::sync0));
    send(encodeCommand(command::sync1));
    send(encodeCommand(command::sync2));
    send(encodeCommand(command::open, 1));
    packets.clear();
  }
  void send(const std::string& bytes) { read(robot.session().receive(bytes, robot.now())); }
  /// @return the SIP after the last step
  const Sip& steps(int count) {
    for (int i = 0; i < count; ++i) {
      robot.session().receive(keeps_alive ? encodeCommand(command::pulse) : "", robot.now());
      robot.session().beforeStep(robot.now());
      robot.environment().step();
      robot.wait(std::chrono::milliseconds(100));
      read(robot.session().cycle());
    }
    return sip;
  }
  /// One step, whose scan the simulator measures too.
  void stepWithScan() {
    const auto channel = robot.channel();
    read(channel->read({}));
  }
  void read(const std::string& bytes) {
    reader.add(bytes);
    while (auto packet = reader.next()) {
      packets.push_back(*packet);
      if (auto decoded = arcos::decodeSip(*packet)) sip = *decoded;
    }
  }
  const arcos::Packet* packet(std::uint8_t id) const {
    for (const auto& each : packets) {
      if (each.id == id) return &each;
    }
    return nullptr;
  }

  SimulatedArcosRobot robot;
  arcos::PacketReader reader;
  std::vector<arcos::Packet> packets;
  Sip sip;
  bool keeps_alive = true;
};

constexpr double kUnit_mm = 0.485;

TEST(ArcosBoard, AnswersTheHandshakeWithItsNameAndNothingElse) {
  SimulatedArcosRobot robot("p3dx");
  auto& session = robot.session();
  EXPECT_EQ(arcos::hex(session.receive(encodeCommand(command::sync0), robot.now())), "fa fb 03 00 00 00");
  robot.step();
  EXPECT_EQ(session.cycle(), "") << "no SIP before OPEN";
  EXPECT_EQ(arcos::hex(session.receive(encodeCommand(command::sync1), robot.now())), "fa fb 03 01 00 01");
  EXPECT_EQ(arcos::hex(session.receive(encodeCommand(command::sync2), robot.now())),
            "fa fb 1a 02 4d 6f 62 69 6c 65 53 69 6d 00 50 69 6f 6e 65 65 72 00 70 33 64 78 00 93 45");
  EXPECT_EQ(session.cycle(), "");
  EXPECT_EQ(session.receive(encodeCommand(command::open, 1), robot.now()), "");
  EXPECT_NE(session.cycle(), "");
}

TEST(ArcosBoard, GripsWhatIsBetweenItsPaddles) {
  BoardProgram program("p3dx_gripper");
  AddObject can;
  can.object.name = "can";
  can.object.movable = Movable{};
  can.object.body = {.shape = Cylinder{0.05}, .world_from_body = {0.31, 0, 0}, .center_z_m = 0.1, .height_m = 0.2};
  ASSERT_EQ(program.robot.environment().apply({"test", can}), "");
  const auto can_x_m = [&] { return program.robot.environment().objects()[0].body.world_from_body.x; };

  program.send(encodeCommand(command::gripper_request, 1));
  program.steps(1);
  const arcos::Packet* packet = program.packet(arcos::packet_type::gripper);
  ASSERT_TRUE(packet);
  EXPECT_EQ(arcos::hex(packet->payload), "02 3c 00") << "general IO; open, both light barriers interrupted";
  EXPECT_EQ(program.sip.gripper, 0x3c);

  program.send(encodeCommand(command::gripper, 2));
  EXPECT_EQ(program.steps(1).gripper, 0x0d) << "not open, both paddles pressed";
  program.send(encodeCommand(command::vel, -200));
  program.steps(20);
  EXPECT_NEAR(can_x_m() - program.robot.truePose().x, 0.31, 1e-9);
  EXPECT_LT(can_x_m(), 0.1);
  program.send(encodeCommand(command::gripper, 1));
  program.steps(1);
  const double dropped_x_m = can_x_m();
  program.steps(10);
  EXPECT_EQ(can_x_m(), dropped_x_m);
}

/// What a camera at AUX1 answers to a message, of which the program requests as many bytes as a hexadecimal text has.
std::string cameraAnswer(BoardProgram& program, const std::string& message, const std::string& expected) {
  program.packets.clear();
  program.send(encodeCommand(command::getaux, static_cast<int>(arcos::fromHex(expected).size())));
  program.send(encodeCommand(command::tty2, arcos::fromHex(message)));
  const arcos::Packet* packet = program.packet(arcos::packet_type::aux);
  return packet ? arcos::hex(packet->payload) : "none";
}

// The messages in the order in which ARIA's ArVCC4 sends them.
TEST(ArcosBoard, MovesItsCameraByTheMessagesOfACanon) {
  BoardProgram program("p3dx_ptz");
  const auto sends = [&](const std::string& message, const std::string& expected) {
    EXPECT_EQ(cameraAnswer(program, message, expected), expected) << message;
  };
  const auto aim = [&] { return program.robot.board().camera(); };
  constexpr const char* kDone = "fe 30 30 30 30 ef";
  sends("ff 30 30 00 58 30 ef", "fe 30 30 39 30 ef");  // not controlled by the program yet
  sends("ff 30 30 00 a0 31 ef", kDone);                // power
  sends("ff 30 30 00 90 30 ef", kDone);                // control
  sends("ff 30 30 00 58 30 ef", kDone);                // init
  sends("ff 30 30 00 50 31 36 34 ef", kDone);          // 356 units/s: 40.05 °/s
  sends("ff 30 30 00 51 32 36 35 ef", kDone);          // 613 units/s: 69 °/s
  sends("ff 30 30 00 64 31 37 45 46 35 38 33 30 45 ef", kDone);
  sends("ff 30 30 00 62 38 31 39 30 37 46 41 37 ef", kDone);  // 45° to the right, 10° down
  program.steps(5);
  EXPECT_NEAR(aim().pan_rad, -20.025 * kRadPerDeg, 1e-9);
  EXPECT_NEAR(aim().tilt_rad, -89 * 0.1125 * kRadPerDeg, 1e-9) << "in two steps";
  // 178 units of pan.
  sends("ff 30 30 00 63 ef", "fe 30 30 30 30 38 30 42 32 37 46 41 37 ef");
  sends("ff 30 30 00 53 30 ef", kDone);  // stop
  program.steps(3);
  EXPECT_NEAR(aim().pan_rad, -20.025 * kRadPerDeg, 1e-9);
  sends("ff 30 30 00 b3 30 33 44 34 ef", kDone);  // half of the zoom: from 1 to 8.5 at 5 per second
  program.steps(10);
  EXPECT_NEAR(aim().zoom, 6, 1e-9);
  // 1960 · 5 / 15 is 653.
  sends("ff 30 30 00 b4 30 ef", "fe 30 30 30 30 30 32 38 44 ef");
  sends("ff 30 30 00 a2 30 ef", kDone);
  program.steps(3);
  EXPECT_NEAR(aim().zoom, 6, 1e-9);
  sends("ff 30 30 00 b3 30 37 41 39 ef", "fe 30 30 35 30 ef");  // more than 1960
  sends("ff 30 30 00 62 38 31 39 30 ef", "fe 30 30 35 30 ef");  // no tilt
  sends("ff 30 30 00 a1 30 ef", kDone);                         // focus, without effect
  sends("ff 30 30 00 a0 30 ef", kDone);                         // power off
  sends("ff 30 30 00 62 38 30 30 30 38 30 30 30 ef", "fe 30 30 39 30 ef");
}

TEST(ArcosBoard, MovesItsCameraByVisca) {
  BoardProgram program("p3dx_ptz");
  constexpr const char* kDone = "90 41 ff 90 51 ff";
  // 440 of 880 units: 50° to the right; 120 of 300 units: 10° up; 341 of 1023: a zoom of 6.
  EXPECT_EQ(cameraAnswer(program, "81 01 06 02 18 14 00 01 0b 08 00 00 07 08 ff", kDone), kDone);
  EXPECT_EQ(cameraAnswer(program, "81 01 04 47 00 01 05 05 ff", kDone), kDone);
  program.steps(10);
  const CameraAim aim = program.robot.board().camera();
  EXPECT_NEAR(aim.pan_rad, -50 * kRadPerDeg, 1e-9);
  EXPECT_NEAR(aim.tilt_rad, 10 * kRadPerDeg, 1e-9);
  EXPECT_NEAR(aim.zoom, 6, 1e-9);
  constexpr const char* kDirection = "90 50 00 01 0b 08 00 00 07 08 ff";
  EXPECT_EQ(cameraAnswer(program, "81 09 06 12 ff", kDirection), kDirection);
  constexpr const char* kZoom = "90 50 00 01 05 05 ff";
  EXPECT_EQ(cameraAnswer(program, "81 09 04 47 ff", kZoom), kZoom);
}

TEST(ArcosBoard, HasNoCameraAtItsPortWithoutOne) {
  BoardProgram program("p3dx");
  EXPECT_EQ(cameraAnswer(program, "ff 30 30 00 a0 31 ef", "fe 30 30 30 30 ef"), "none");
}

TEST(ArcosBoard, SendsTheReadingsOfItsGyroUntilTheyAreSwitchedOff) {
  BoardProgram program("p3dx_gyro");
  program.send(encodeCommand(command::config));
  const auto config = arcos::decodeConfig(*program.packet(arcos::packet_type::config));
  ASSERT_TRUE(config);
  EXPECT_TRUE(config->has_gyro);
  program.send(encodeCommand(command::gyro, 1));
  program.send(encodeCommand(command::rvel, 50));
  program.steps(10);  // 100 °/s² in steps of 0.1 s
  program.packets.clear();
  program.steps(1);
  const arcos::Packet* packet = program.packet(arcos::packet_type::gyro);
  ASSERT_TRUE(packet);
  EXPECT_EQ(arcos::encode(packet->id, packet->payload), arcos::encodeGyro(50 * M_PI / 180));
  program.send(encodeCommand(command::gyro, 0));
  program.packets.clear();
  program.steps(1);
  EXPECT_FALSE(program.packet(arcos::packet_type::gyro));
}

TEST(ArcosBoard, WithoutAGripperSaysSo) {
  BoardProgram program;
  program.send(encodeCommand(command::gripper_request, 1) + encodeCommand(command::gripper, 2));
  program.steps(1);
  const arcos::Packet* packet = program.packet(arcos::packet_type::gripper);
  ASSERT_TRUE(packet);
  EXPECT_EQ(packet->payload[0], '\0');
  EXPECT_EQ(program.sip.gripper, 0);
}

TEST(ArcosBoard, AcceptsAnotherSync0AtAnyPointOfTheHandshake) {
  SimulatedArcosRobot robot("p3dx");
  auto& session = robot.session();
  for (const auto& before : {std::string(), encodeCommand(command::sync0), encodeCommand(command::sync1),
                             encodeCommand(command::sync2), encodeCommand(command::config, 1)}) {
    session.receive(before, robot.now());
    EXPECT_EQ(arcos::hex(session.receive(encodeCommand(command::sync0), robot.now())), "fa fb 03 00 00 00");
  }
}

TEST(ArcosBoard, IsClaimedAtTheEndOfTheHandshakeOnly) {
  SimulatedArcosRobot robot("p3dx");
  int claims = 0;
  ArcosSession session(
      [&]() -> std::optional<ArcosSession::Robot> {
        ++claims;
        return std::nullopt;
      },
      robot.now());
  session.receive(encodeCommand(command::sync0) + encodeCommand(command::sync1), robot.now());
  EXPECT_EQ(claims, 0);
  EXPECT_EQ(session.receive(encodeCommand(command::sync2) + encodeCommand(command::open, 1), robot.now()), "");
  EXPECT_EQ(claims, 1);
  EXPECT_EQ(session.endReason(), "no robot is free");
}

TEST(ArcosBoard, ReportsAStandingRobotWithMotorsAndSonarOn) {
  BoardProgram program;
  program.steps(1);
  EXPECT_EQ(program.sip.flags, Sip::kMotorsOn | Sip::kSonarOn);
  EXPECT_FALSE(program.sip.is_moving);
  EXPECT_EQ(program.sip.battery, 130);
  EXPECT_EQ(program.sip.sonars.size(), 16u);
  EXPECT_EQ(program.sip.sonars[0].range, 5000) << "no echo";
  EXPECT_EQ(program.sip.x, 0);
}

TEST(ArcosBoard, AcceleratesTo300MillimetresPerSecondIn10Cycles) {
  BoardProgram program;
  program.send(encodeCommand(command::vel, 300));
  EXPECT_EQ(program.steps(1).speed_left, 30) << "0.3 m/s² for 0.1 s";
  EXPECT_EQ(program.steps(9).speed_left, 300);
  EXPECT_EQ(program.sip.speed_right, 300);
  // 0.03 + 0.06 + … + 0.30 m/s, 0.1 s each
  EXPECT_NEAR(program.sip.x * kUnit_mm, 165, kUnit_mm);
  EXPECT_TRUE(program.sip.is_moving);
}

TEST(ArcosBoard, ReportsOdometryModulo16Bits) {
  BoardProgram program;
  program.send(encodeCommand(command::vel, -300));
  program.steps(10);
  EXPECT_EQ(program.sip.x, static_cast<std::uint16_t>(-std::lround(165 / kUnit_mm)));
}

TEST(ArcosBoard, DrivesASignedDistanceAndStops) {
  for (const int distance_mm : {500, 2000, -1000}) {
    BoardProgram program;
    program.send(encodeCommand(command::move, distance_mm));
    program.steps(120);
    EXPECT_NEAR(program.robot.truePose().x * 1000, distance_mm, 1) << distance_mm;
    EXPECT_FALSE(program.sip.is_moving);
  }
}

TEST(ArcosBoard, TurnsToAHeadingTheShorterWayRound) {
  BoardProgram program;
  program.send(encodeCommand(command::head, 170));
  program.steps(60);
  EXPECT_NEAR(program.robot.truePose().phi, toRadians(170), 1e-6);
  program.send(encodeCommand(command::head, -170));
  EXPECT_GT(program.steps(1).turn_rate, 0) << "counter-clockwise over 180°";
  program.steps(30);
  EXPECT_NEAR(program.robot.truePose().phi, toRadians(-170), 1e-6);
  EXPECT_EQ(program.sip.heading, std::lround(-170.0 / 360 * 4096));
  program.send(encodeCommand(command::dhead, -20));
  program.steps(30);
  EXPECT_NEAR(program.robot.truePose().phi, toRadians(170), 1e-6);
}

TEST(ArcosBoard, TurnsAtTheRateOfRvelAndOfTwoWheelSpeeds) {
  BoardProgram program;
  program.send(encodeCommand(command::rvel, -10));
  EXPECT_EQ(program.steps(5).turn_rate, -100) << "0.1 °/s";
  // 300 and 100 mm/s: left in the high byte, in units of 20 mm/s.
  program.send(encodeCommand(command::vel2, 0x0F05));
  program.steps(20);
  EXPECT_EQ(program.sip.speed_left, 300);
  EXPECT_EQ(program.sip.speed_right, 100);
  EXPECT_NEAR(program.sip.turn_rate / 10.0, -32, 0.2);
  // -100 and 100 mm/s: the combined value is negative.
  program.send(encodeCommand(command::vel2, static_cast<std::int16_t>(0xFB05)));
  program.steps(20);
  EXPECT_EQ(program.sip.speed_left, -100);
  EXPECT_EQ(program.sip.speed_right, 100);
}

TEST(ArcosBoard, UsesTheLimitsOfTheProgram) {
  BoardProgram program;
  program.send(encodeCommand(command::setv, 200) + encodeCommand(command::seta, 1000) +
               encodeCommand(command::seta, -500) + encodeCommand(command::vel, 400));
  EXPECT_EQ(program.steps(1).speed_left, 100) << "1 m/s² for 0.1 s";
  EXPECT_EQ(program.steps(5).speed_left, 200);
  program.send(encodeCommand(command::stop));
  EXPECT_EQ(program.steps(1).speed_left, 150) << "0.5 m/s² for 0.1 s";
}

TEST(ArcosBoard, StandsWithAMaximumSpeedOf0) {
  BoardProgram program;
  program.send(encodeCommand(command::vel, 300) + encodeCommand(command::rvel, 40));
  program.steps(15);
  program.send(encodeCommand(command::setv, 0) + encodeCommand(command::setrv, 0));
  program.steps(15);
  EXPECT_EQ(program.sip.speed_left, 0);
  EXPECT_EQ(program.sip.turn_rate, 0);
}

TEST(ArcosBoard, CompletesAMoveWhenItsMotorsAreEnabledAgainOrTheLinkWasSilent) {
  BoardProgram program;
  program.send(encodeCommand(command::move, 2000));
  program.steps(5);
  program.send(encodeCommand(command::enable, 1));
  program.steps(10);
  program.keeps_alive = false;
  program.steps(30);
  EXPECT_FALSE(program.sip.is_moving);
  program.keeps_alive = true;
  program.steps(120);
  EXPECT_NEAR(program.robot.truePose().x, 2, 0.001);
}

TEST(ArcosBoard, StopsAtTheMaximumDecelerationInAnEmergency) {
  BoardProgram program;
  program.send(encodeCommand(command::vel, 300));
  program.steps(10);
  program.send(encodeCommand(command::estop) + encodeCommand(command::vel, 300));
  EXPECT_EQ(program.steps(1).speed_left, 100) << "2 m/s² for 0.1 s: motion is ignored until it stands";
  EXPECT_EQ(program.steps(2).speed_left, 0);
  program.send(encodeCommand(command::vel, 300));
  EXPECT_EQ(program.steps(1).speed_left, 30);
}

TEST(ArcosBoard, StandsWhileItsMotorsAreDisabled) {
  BoardProgram program;
  program.send(encodeCommand(command::vel, 300));
  program.steps(10);
  program.send(encodeCommand(command::enable, 0) + encodeCommand(command::vel, 300));
  program.steps(5);
  EXPECT_FALSE(program.sip.is_moving);
  EXPECT_EQ(program.sip.flags & Sip::kMotorsOn, 0);
  program.send(encodeCommand(command::enable, 1));
  program.steps(5);
  EXPECT_FALSE(program.sip.is_moving) << "it waits for a new command";
  program.send(encodeCommand(command::vel, 300));
  EXPECT_TRUE(program.steps(1).is_moving);
}

TEST(ArcosBoard, StandsWhenItHasReceivedNothingFor2SecondsAndContinuesWithTheNextPacket) {
  BoardProgram program;
  program.send(encodeCommand(command::vel, 300));
  program.keeps_alive = false;
  program.steps(19);
  EXPECT_EQ(program.sip.speed_left, 300);
  EXPECT_EQ(program.steps(1).speed_left, 300);
  EXPECT_EQ(program.steps(1).speed_left, 100) << "the hardware's deceleration: 2 m/s² for 0.1 s";
  program.steps(15);
  EXPECT_EQ(program.sip.speed_left, 0);
  program.keeps_alive = true;
  EXPECT_EQ(program.steps(3).speed_left, 90);
}

TEST(ArcosBoard, SwitchesItsSonarsOffAndOn) {
  BoardProgram program;
  program.send(encodeCommand(command::sonar, 0));
  program.steps(1);
  EXPECT_EQ(program.sip.flags, Sip::kMotorsOn);
  EXPECT_TRUE(program.sip.sonars.empty());
  program.send(encodeCommand(command::sonar, 1));
  EXPECT_EQ(program.steps(1).sonars.size(), 16u);
}

// The exact ranges along the axes of the sonars of a p3dx in the middle of a square room of 5 m.
TEST(ArcosBoard, MeasuresSonarAlongTheAxesInASquareRoom) {
  BoardProgram program("p3dx", {}, 5);
  program.steps(1);
  std::vector<int> ranges_mm;
  for (const auto& sonar : program.sip.sonars) ranges_mm.push_back(sonar.range);
  EXPECT_EQ(ranges_mm, (std::vector<int>{2364, 3108, 2716, 2370, 2370, 2716, 3108, 2364, 2364, 3108, 2613, 2280, 2280,
                                         2613, 3108, 2364}));
}

// The laser of a p3dx is 18 mm ahead of its centre: 2482 mm from the wall ahead, 2500 mm from those at the sides.
TEST(ArcosBoard, ScansARoomFromTheRightToTheLeftAtTheRequestedResolution) {
  for (const int increment : {100, 50, 33}) {
    BoardProgram program("p3dx", {}, 5);
    program.send(encodeCommand(command::old_laser_start, -90) + encodeCommand(command::old_laser_end, 90) +
                 encodeCommand(command::old_laser_increment, increment) + encodeCommand(command::old_laser_enable, 2));
    arcos::ScanAssembler assembler;
    program.packets.clear();
    program.stepWithScan();
    for (const auto& packet : program.packets) assembler.add(packet);
    const auto& scan = assembler.scan();
    ASSERT_EQ(scan.size(), 18000u / static_cast<unsigned>(increment) + 1);
    EXPECT_EQ(scan.front(), 2500);
    for (std::size_t i = 0; i < scan.size(); ++i) {
      const double angle = toRadians(-90 + static_cast<double>(i) * increment / 100);
      const double ahead = std::cos(angle) > 1e-9 ? 2482 / std::cos(angle) : 1e9;
      const double aside = std::abs(std::sin(angle)) > 1e-9 ? 2500 / std::abs(std::sin(angle)) : 1e9;
      EXPECT_NEAR(scan[i], std::min(ahead, aside), 0.51) << i;
    }
  }
}

TEST(ArcosBoard, ReportsTheStallAndTheBumpersThatTouchAWall) {
  BoardProgram program("p3dx", {}, 5);
  program.send(encodeCommand(command::vel, 300));
  program.steps(100);
  EXPECT_EQ(program.sip.stall_left & Sip::kStalled, 1);
  EXPECT_EQ(program.sip.stall_right & Sip::kStalled, 1);
  // Five segments of 36° in front, counted from the left from bit 1: the third one is straight ahead.
  EXPECT_NE(program.sip.stall_right & 0x08, 0);
  EXPECT_EQ(program.sip.stall_left & ~Sip::kStalled, 0) << "no contact behind";
  program.send(encodeCommand(command::vel, -300));
  program.steps(5);
  EXPECT_EQ(program.sip.stall_left, 0);
  EXPECT_EQ(program.sip.stall_right, 0);
}

TEST(ArcosBoard, SetsItsOdometryWithoutMoving) {
  BoardProgram program("p3dx", {1, 2, 0.5});
  program.send(encodeCommand(command::vel, 300));
  program.steps(10);
  program.send(encodeCommand(command::stop));
  program.steps(20);
  const auto before = program.robot.truePose();
  program.send(encodeCommand(command::seto));
  program.steps(1);
  EXPECT_EQ(program.sip.x, 0);
  EXPECT_EQ(program.sip.y, 0);
  EXPECT_EQ(program.sip.heading, 0);
  program.send(arcos::encode(command::seto, std::string("\xE8\x03\x00\x00\x5A\x00", 6)));  // 1000 mm, 0, 90°
  program.steps(1);
  EXPECT_EQ(program.sip.x, std::lround(1000 / kUnit_mm));
  EXPECT_EQ(program.sip.heading, 1024);
  EXPECT_EQ(program.robot.truePose(), before);
}

TEST(ArcosBoard, PlacesTheTrueRobotWithoutChangingItsOdometry) {
  BoardProgram program;
  program.send(arcos::encodeSetPose({500, 600, 90}));
  program.steps(1);
  EXPECT_NEAR(program.robot.truePose().x, 0.5, 1e-9);
  EXPECT_NEAR(program.robot.truePose().y, 0.6, 1e-9);
  EXPECT_EQ(program.sip.x, 0);
  EXPECT_EQ(program.sip.heading, 0);
  program.send(arcos::encode(command::sim_reset));
  program.steps(1);
  EXPECT_NEAR(program.robot.truePose().x, 0, 1e-9);
}

TEST(ArcosBoard, AnswersRequestsOnceOrInEachCycle) {
  BoardProgram program;
  program.send(encodeCommand(command::config));
  ASSERT_TRUE(program.packet(arcos::packet_type::config));
  const auto config = arcos::decodeConfig(*program.packet(arcos::packet_type::config));
  ASSERT_TRUE(config);
  EXPECT_EQ(config->serial, "SIM");
  EXPECT_EQ(config->subclass, "p3dx");
  EXPECT_EQ(config->speed_top, 2200);
  EXPECT_EQ(config->turn_top, 500);
  EXPECT_EQ(config->accel, 300);
  const std::vector<std::pair<std::uint8_t, std::uint8_t>> requests{{command::encoder, arcos::packet_type::encoder},
                                                                    {command::io_request, arcos::packet_type::io},
                                                                    {command::sim_stat, arcos::packet_type::sim_stat}};
  for (const auto& [id, type] : requests) {
    const auto count = [&program, type = type](int mode_steps) {
      program.packets.clear();
      program.steps(mode_steps);
      return std::count_if(program.packets.begin(), program.packets.end(),
                           [type](const auto& packet) { return packet.id == type; });
    };
    program.send(encodeCommand(id, 1));
    EXPECT_EQ(count(3), 1) << int{id};
    program.send(encodeCommand(id, 2));
    EXPECT_EQ(count(3), 3) << int{id};
    program.send(encodeCommand(id, 0));
    EXPECT_EQ(count(3), 0) << int{id};
  }
}

TEST(ArcosBoard, CountsCommandsPerCycleAlsoWhileTheRunIsPaused) {
  BoardProgram program;
  std::string commands;
  for (std::size_t i = 0; i < ArcosSession::kCommandsPerCycleMax; ++i) commands += encodeCommand(command::pulse);
  for (int cycle = 0; cycle < 20; ++cycle) {  // no steps are taken
    program.robot.session().cycle();
    program.send(commands);
    ASSERT_EQ(program.robot.session().endReason(), "") << "cycle " << cycle;
  }
  program.send(encodeCommand(command::pulse));
  EXPECT_EQ(program.robot.session().endReason(), "it sends more than 2000 commands in a cycle");
}

TEST(ArcosBoard, AnswersARequestToLoadAMapByTheMapInUse) {
  BoardProgram program;
  arcos::ByteWriter request;
  request.add(std::uint8_t{0x2B}).add(arcos::sim_operation::load_map).add(std::uint16_t{9}).addText("other.map");
  program.send(arcos::encode(command::sim_control, request.bytes()));
  const auto* answer = program.packet(arcos::packet_type::sim_map);
  ASSERT_TRUE(answer);
  arcos::ByteReader map(answer->payload);
  EXPECT_EQ(map.take<std::uint8_t>(), 0) << "not by an operator";
  EXPECT_EQ(map.take<std::uint8_t>(), 0) << "no other map is loaded";
  EXPECT_EQ(map.takeText(), "here.map");
  EXPECT_EQ(program.robot.asked_map, "other.map");
}

TEST(ArcosBoard, LeavesTheAnswerToARequestForAMapToASimulatorThatLoadsIt) {
  BoardProgram program;
  program.robot.loads_maps = true;
  arcos::ByteWriter request;
  request.add(std::uint8_t{0x2B}).add(arcos::sim_operation::load_map).add(std::uint16_t{9}).addText("other.map");
  program.send(arcos::encode(command::sim_control, request.bytes()));
  EXPECT_EQ(program.robot.asked_map, "other.map");
  EXPECT_FALSE(program.packet(arcos::packet_type::sim_map));
}

TEST(ArcosBoard, SendsNoScansOfALaserThatTheRobotHasNot) {
  BoardProgram program("p3dx", {}, 5);
  for (const std::uint8_t laser : {1, 9}) {
    arcos::ByteWriter enable;
    enable.add(std::uint8_t{0x3B}).add(std::uint16_t{2}).add(laser);
    program.send(arcos::encode(command::laser_enable, enable.bytes()));
  }
  program.packets.clear();
  program.stepWithScan();
  EXPECT_FALSE(program.packet(arcos::packet_type::laser_extended)) << "a p3dx has one laser";
}

TEST(ArcosBoard, IgnoresUnknownCommandsAndWrongArguments) {
  BoardProgram program;
  for (int id = 0; id < 256; ++id) {
    if (id == command::close) continue;
    program.send(arcos::encode(static_cast<std::uint8_t>(id), "xy"));
  }
  program.steps(2);
  EXPECT_EQ(program.robot.session().endReason(), "");
  EXPECT_FALSE(program.sip.is_moving);
}

TEST(ArcosBoard, EndsTheSessionOnRequestAndForGarbage) {
  BoardProgram polite;
  polite.send(encodeCommand(command::close, 1));
  EXPECT_EQ(polite.robot.session().endReason(), "it has closed the session");
  BoardProgram noisy;
  noisy.send(std::string(5000, 'x'));
  EXPECT_EQ(noisy.robot.session().endReason(), "it sends bytes that are no ARCOS packets");
  BoardProgram flooding;
  std::string flood;
  for (int i = 0; i < 2001; ++i) flood += encodeCommand(command::pulse);
  flooding.send(flood);
  EXPECT_EQ(flooding.robot.session().endReason(), "it sends more than 2000 commands in a cycle");
  BoardProgram silent;
  silent.robot.wait(std::chrono::seconds(61));
  silent.send("");
  EXPECT_EQ(silent.robot.session().endReason(), "it has sent nothing for a minute");
  SimulatedArcosRobot slow("p3dx");
  slow.session().receive(encodeCommand(command::sync0), slow.now());
  slow.wait(std::chrono::seconds(59));
  slow.session().receive(encodeCommand(command::sync1), slow.now());
  slow.wait(std::chrono::seconds(2));
  slow.session().receive("", slow.now());
  EXPECT_EQ(slow.session().endReason(), "it has not completed the handshake in time");
}

}  // namespace
}  // namespace robosim
