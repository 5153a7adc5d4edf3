// Programs that speak ARCOS over TCP: their sessions, and what misbehaving ones can do.
#include "serving/arcos_server.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <vector>

#include <boost/asio.hpp>
#include <gtest/gtest.h>

#include "arcos/protocol/bytes.h"
#include "arcos/protocol/command.h"
#include "arcos/protocol/laser_packets.h"
#include "arcos/protocol/simulator_packets.h"
#include "arcos/protocol/sip.h"
#include "base/angle_units.h"
#include "base/portable_pose.h"
#include "environment/testing/small_world.h"
#include "environment/world_changes.h"
#include "net/testing/address_flood.h"
#include "robots/fleet.h"
#include "robots/robot_types.h"
#include "robots/start_places.h"
#include "tests/scenarios/program.h"
#include "tests/scenarios/served_robots.h"
#include "tests/scenarios/wait.h"

namespace robosim {
namespace {

namespace command = arcos::command;
using arcos::encodeCommand;

TEST(ArcosServer, DrivesEachRobotByTheProgramAtItsPort) {
  ServedRobots served(2);
  TcpProgram first(served, served.server->ports()[0]), second(served, served.server->ports()[1]);
  first.open();
  second.open();
  first.send(encodeCommand(command::vel, 300));
  second.send(encodeCommand(command::rvel, 20));
  // Both commands are in the server's sockets, so that the next step executes them.
  EXPECT_EQ(first.step().speed_left, 30);
  EXPECT_GT(served.environment->state().turn_radps[1], 0);
  EXPECT_EQ(served.environment->state().speed_mps[1], 0);
  EXPECT_EQ(served.server->clients(), 2u);
}

TEST(ArcosServer, RefusesASecondProgramAtAnOccupiedRobotAtOnce) {
  ServedRobots served(1);
  TcpProgram first(served, served.server->ports()[0]);
  first.open();
  TcpProgram second(served, served.server->ports()[0]);
  EXPECT_TRUE(second.isClosed());
  EXPECT_NE(served.log.find("robot P1 has a program already"), std::string::npos) << served.log;
  EXPECT_EQ(first.step().flags & arcos::Sip::kMotorsOn, 1) << "the first one continues";
}

/// Pose, relative to its start, at which a robot stands after ARIA's simple motion commands: ahead at 250 mm/s for 5 s,
/// a turn of 10 °/s for 5 s and of -10 °/s for 10 s, ahead at 150 mm/s for 5 s, with a stop after each drive.
mrpt::math::TPose2D afterSimpleMotion(ServedRobots& served, std::size_t robot) {
  TcpProgram program(served, served.server->ports()[robot]);
  program.open();
  const auto send_for = [&](int steps, const std::string& commands) {
    program.send(commands);
    for (int i = 0; i < steps; ++i) {
      program.step();
      program.send(encodeCommand(command::pulse));
    }
  };
  send_for(50, encodeCommand(command::vel, 250));
  send_for(10, encodeCommand(command::stop));
  send_for(50, encodeCommand(command::rvel, 10));
  send_for(100, encodeCommand(command::rvel, -10));
  send_for(50, encodeCommand(command::rvel, 0) + encodeCommand(command::vel, 150));
  send_for(10, encodeCommand(command::stop));
  return portable::relative(served.environment->fleet().robots[robot].world_from_start,
                            served.environment->state().world_from_robot[robot]);
}

/// The world of `robosim arcos maps/office.map -r p3dx …`.
LoadedWorld officeWith(std::size_t robots) {
  WorldChanges changes;
  changes.robots.assign(robots, {"p3dx", std::nullopt});
  return changedWorld(ROBOSIM_SOURCE_DIR "/maps/office.map", changes, {}, 1);
}

/// Robots in an open world, the first at the origin and the others as `robosim arcos -r` places them.
LoadedWorld openWorldWith(std::size_t robots) {
  const RobotTypes types = robotTypesIn({ROBOSIM_SOURCE_DIR "/worlds/robots"});
  LoadedWorld made{emptyWorld(20), {}};
  for (std::size_t i = 0; i < robots; ++i) {
    RobotPlacement robot;
    robot.name = "P" + std::to_string(i + 1);
    robot.model = "p3dx";
    if (i > 0) robot.world_from_robot = findStartBeside(made.world, "open.xml", types, "p3dx").value();
    made.world.robots.push_back(robot);
  }
  ErrorList errors;
  made.fleet = buildFleet(made.world, "open.xml", types, {}, errors);
  errors.throwIfAny();
  return made;
}

// At 300 mm/s² and 100 °/s², a speed of v for a time t and the way to rest after it are v · t together; the turn comes
// to rest within a step, before it reverses: 50° - 99° = -49°.
void expectEndOfSimpleMotion(const mrpt::math::TPose2D& end) {
  const double turned = toRadians(-49);
  EXPECT_NEAR(end.x, 1.25 + 0.75 * std::cos(turned), 1e-6);
  EXPECT_NEAR(end.y, 0.75 * std::sin(turned), 1e-6);
  EXPECT_NEAR(end.phi, turned, 1e-6);
}

TEST(ArcosServer, EndsSimpleMotionCommandsAtTheSamePlaceBesideOtherRobots) {
  for (const std::size_t robots : {1, 2, 4}) {
    for (std::size_t i = 0; i < robots; ++i) {
      SCOPED_TRACE("robot " + std::to_string(i) + " of " + std::to_string(robots));
      ServedRobots served(openWorldWith(robots));
      expectEndOfSimpleMotion(afterSimpleMotion(served, i));
    }
  }
  for (const std::size_t robots : {1, 2}) {
    SCOPED_TRACE("of " + std::to_string(robots) + " in the office");
    ServedRobots served(officeWith(robots));
    expectEndOfSimpleMotion(afterSimpleMotion(served, 0));
  }
}

TEST(ArcosServer, StartsRobotsOfAMapAMetreApart) {
  const LoadedWorld office = officeWith(4);
  const auto& robots = office.fleet.robots;
  for (std::size_t i = 0; i < robots.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      const auto between = portable::relative(robots[i].world_from_start, robots[k].world_from_start);
      EXPECT_GE(std::hypot(between.x, between.y) - 2 * robots[0].info.radius_m, 1 - 1e-9) << i << ", " << k;
    }
  }
}

TEST(ArcosServer, FreesARobotWhoseProgramHasEndedAndStopsIt) {
  ServedRobots served(1);
  for (int round = 0; round < 3; ++round) {
    TcpProgram program(served, served.server->ports()[0]);
    program.open();
    program.send(encodeCommand(command::vel, 300));
    EXPECT_EQ(program.step().speed_left, 30);
    if (round == 0) program.send(encodeCommand(command::close, 1));
    program.close();
    waitUntil("the robot is free", [&] {
      served.server->poll();
      return served.server->clients() == 0;
    });
    for (int i = 0; i < 5; ++i) served.step();
    EXPECT_EQ(served.environment->state().speed_mps[0], 0);
  }
  TcpProgram next(served, served.server->ports()[0]);
  next.open();
  EXPECT_EQ(next.step().x, 0) << "odometry begins at 0 in each session";
}

TEST(ArcosServer, BringsARobotForEachProgramOfAFactoryAndRemovesItAfterwards) {
  ServedRobots served(2, true);
  const auto& state = served.environment->state();
  const int port = served.server->ports()[0];
  EXPECT_EQ(served.server->ports()[1], port);
  served.step();
  EXPECT_EQ(state.activity, std::vector(2, Activity::absent));
  TcpProgram first(served, port);
  first.open();
  EXPECT_EQ(state.activity, (std::vector{Activity::active, Activity::absent}));
  TcpProgram second(served, port);
  second.open();
  first.send(encodeCommand(command::vel, 800));
  for (int i = 0; i < 10; ++i) first.step();
  EXPECT_GT(state.world_from_robot[0].x, -10);
  EXPECT_EQ(state.speed_mps[1], 0);
  TcpProgram third(served, port);
  EXPECT_TRUE(third.isClosed());
  EXPECT_NE(served.log.find("all 2 robots have a program or cannot enter"), std::string::npos) << served.log;
  first.close();
  waitUntil("the robot has left", [&] {
    served.server->poll();
    return state.activity[0] == Activity::absent;
  });
  served.step();
  TcpProgram fourth(served, port);
  fourth.open();
  EXPECT_EQ(state.activity[0], Activity::active);
  EXPECT_EQ(state.world_from_robot[0].x, -10) << "at its start";
  EXPECT_EQ(fourth.step().x, 0) << "odometry begins at 0";
}

TEST(ArcosServer, LosesOnlyTheConnectionsOfMisbehavingPrograms) {
  ServedRobots served(4);
  const auto ports = served.server->ports();
  TcpProgram good(served, ports[0]), garbage(served, ports[1]), flooding(served, ports[2]), slow(served, ports[3]);
  good.open();
  garbage.open();
  flooding.open();
  slow.open();
  garbage.send(std::string(8000, '\xFA'));
  EXPECT_TRUE(garbage.isClosed());
  std::string flood;
  for (int i = 0; i < 5000; ++i) flood += encodeCommand(command::pulse);
  flooding.send(flood);
  EXPECT_TRUE(flooding.isClosed());
  // The widest scan, which this program does not receive.
  slow.send(encodeCommand(command::old_laser_start, -180) + encodeCommand(command::old_laser_end, 180) +
            encodeCommand(command::old_laser_increment, 10) + encodeCommand(command::old_laser_enable, 2));
  for (int i = 0; i < 1000; ++i) {
    good.send(encodeCommand(command::rvel, 10));
    if (i % 10 == 0) slow.send(encodeCommand(command::pulse));
    ASSERT_NE(good.step().flags, 0) << i;
  }
  EXPECT_EQ(good.step().turn_rate, 100) << "0.1 °/s";
  EXPECT_LE(served.server->clients(), 2u);
}

TEST(ArcosServer, HandlesABoundedNumberOfConnectionsInOnePoll) {
  constexpr std::size_t kFlood = 400, kMaxEvents = 64;
  ServedRobots served(1);
  TcpProgram program(served, served.server->ports()[0]);
  program.open();
  std::vector<std::unique_ptr<TcpProgram>> flood;
  for (std::size_t i = 0; i < kFlood; ++i) {
    flood.push_back(std::make_unique<TcpProgram>(served, served.server->ports()[0], TcpProgram::Server::waits));
    flood.back()->send("\xfa\xfb\xff");
  }
  served.server->poll();
  EXPECT_LE(std::count_if(flood.begin(), flood.end(), [](const auto& one) { return one->hasEnded(); }), kMaxEvents);
  for (const auto& one : flood) EXPECT_TRUE(one->isClosed());
  EXPECT_NE(program.step().flags, 0);
}

TEST(ArcosServer, GivesARobotToTheFirstProgramThatCompletesTheHandshake) {
  ServedRobots served(1);
  TcpProgram silent(served, served.server->ports()[0]), incomplete(served, served.server->ports()[0]);
  incomplete.send(encodeCommand(command::sync0));
  EXPECT_EQ(incomplete.next().id, command::sync0);
  EXPECT_EQ(served.server->clients(), 0u);
  TcpProgram program(served, served.server->ports()[0]);
  program.open();
  EXPECT_EQ(served.server->clients(), 1u);
  incomplete.send(encodeCommand(command::sync1) + encodeCommand(command::sync2) + encodeCommand(command::open, 1) +
                  encodeCommand(command::vel, 300));
  EXPECT_EQ(incomplete.next().id, command::sync1);
  EXPECT_TRUE(incomplete.isClosed());
  EXPECT_NE(served.log.find("robot P1 has a program already"), std::string::npos) << served.log;
  EXPECT_EQ(program.step().speed_left, 0) << "its commands had no effect";
}

TEST(ArcosServer, ServesProgramsDuringAFloodFrom1000Addresses) {
  ServedRobots served(2);
  TcpProgram before(served, served.server->ports()[0]);
  before.open();
  const AddressFlood flood(served.server->ports()[1], "\xfa\xfb\xff");
  flood.waitForAll();
  TcpProgram during(served, served.server->ports()[1]);
  during.open();
  during.send(encodeCommand(command::vel, 300));
  before.send(encodeCommand(command::vel, 300));
  // During a flood a poll reads a bounded number of connections, so that a command may wait for the next one.
  const auto& speed_mps = served.environment->state().speed_mps;
  waitUntil("both robots drive", [&] {
    served.server->poll();
    served.step();
    return speed_mps[0] > 0 && speed_mps[1] > 0;
  });
  EXPECT_EQ(served.server->clients(), 2u);
}

TEST(ArcosServer, SendsSipsOfAPausedRunToo) {
  ServedRobots served(1);
  TcpProgram program(served, served.server->ports()[0]);
  program.open();
  // The run takes no steps; the server sends the state every second.
  EXPECT_TRUE(arcos::decodeSip(program.next()));
}

TEST(ArcosServer, StartsTheCountOfCommandsInEachCycleOfAPausedRun) {
  ServedRobots served(1);
  TcpProgram program(served, served.server->ports()[0]);
  program.open();
  std::string commands;
  for (int i = 0; i < 1500; ++i) commands += encodeCommand(command::pulse);
  for (int cycle = 0; cycle < 2; ++cycle) {  // of 1 s; 2,000 commands in one of them would end the session
    program.send(commands);
    EXPECT_TRUE(arcos::decodeSip(program.next())) << served.log;
  }
  EXPECT_EQ(served.server->clients(), 1u);
}

TEST(ArcosServer, AnswersARequestToLoadAMap) {
  ServedRobots served(1);
  TcpProgram program(served, served.server->ports()[0]);
  program.open();
  arcos::ByteWriter request;
  request.add(std::uint8_t{0x2B}).add(arcos::sim_operation::load_map).add(std::uint16_t{9}).addText("other.map");
  program.send(arcos::encode(command::sim_control, request.bytes()));
  EXPECT_EQ(program.next().id, arcos::packet_type::sim_map);
}

std::string loadMapCommand(const std::string& file) {
  arcos::ByteWriter request;
  request.add(std::uint8_t{0x2B}).add(arcos::sim_operation::load_map);
  request.add(static_cast<std::uint16_t>(file.size())).addText(file);
  return arcos::encode(command::sim_control, request.bytes());
}

/// The next SIM_MAP_CHANGED that a program receives: "not loaded here.map".
std::string nextMap(TcpProgram& program) {
  arcos::Packet packet = program.next();
  while (packet.id != arcos::packet_type::sim_map && !program.hasEnded()) packet = program.next();
  arcos::ByteReader bytes(packet.payload);
  bytes.take<std::uint8_t>();  // whether an operator has loaded it
  const bool is_loaded = bytes.take<std::uint8_t>() != 0;
  return (is_loaded ? "loaded " : "not loaded ") + bytes.takeText();
}

TEST(ArcosServer, ContinuesTheSessionsOfProgramsWithTheRobotsOfAMapThatOneHasLoaded) {
  ServedRobots served(rowOfRobots(2), false, "maps/here.map");
  TcpProgram first(served, served.server->ports()[0]), second(served, served.server->ports()[1]);
  first.open();
  second.open();
  first.send(encodeCommand(command::vel, 300));
  for (int i = 0; i < 10; ++i) first.step();
  second.step();
  first.send(loadMapCommand("/home/anyone/there.map"));
  std::optional<std::string> request;
  waitUntil("the request arrives", [&] {
    served.server->poll();
    request = served.server->takeMapRequest();
    return request.has_value();
  });
  EXPECT_EQ(*request, "there.map") << "a file beside the map, wherever the program has it";
  EXPECT_FALSE(served.server->takeMapRequest()) << "it is being loaded";
  ServedRobots next(rowOfRobots(2), false, "maps/there.map");
  next.server->takePrograms(*served.server);
  served.server = std::move(next.server);
  served.environment.swap(next.environment);
  EXPECT_EQ(served.server->clients(), 2u);
  EXPECT_EQ(nextMap(first), "loaded there.map");
  EXPECT_EQ(nextMap(second), "loaded there.map");
  const arcos::Sip sip = first.step();
  EXPECT_EQ(sip.x, 0) << "at the start, with odometry 0";
  EXPECT_EQ(sip.speed_left, 0);
  first.send(encodeCommand(command::vel, 300));
  EXPECT_EQ(first.step().speed_left, 30) << "it drives the robot on the new map";
}

TEST(ArcosServer, AnswersProgramsWhoseMapIsRefusedByTheMapInUse) {
  ServedRobots served(rowOfRobots(1), false, "maps/here.map");
  TcpProgram program(served, served.server->ports()[0]);
  program.open();
  program.send(loadMapCommand("here.map"));
  EXPECT_EQ(nextMap(program), "not loaded here.map") << "it is in use";
  EXPECT_FALSE(served.server->takeMapRequest());
  program.send(loadMapCommand("there.map"));
  waitUntil("the request arrives", [&] {
    served.server->poll();
    return served.server->takeMapRequest().has_value();
  });
  program.send(loadMapCommand("third.map"));
  EXPECT_EQ(nextMap(program), "not loaded here.map") << "another one is being loaded";
  served.server->refuseMap("there.map:3: is no wall");
  EXPECT_EQ(nextMap(program), "not loaded here.map");
  EXPECT_NE(served.log.find("the map there.map is not loaded: there.map:3: is no wall"), std::string::npos)
      << served.log;
}

TEST(ArcosServer, MeasuresTheSecondLaserOfATypeAndTheReflectanceOfReflectors) {
  // The first robot has lasers at its centre and 0.5 m behind it; a reflector is 2 m ahead, a wall 3 m to the left.
  LoadedWorld made{emptyWorld(20), {}};
  addWall(made.world, 2.1, 0, 0.2, 1);
  made.world.objects.back().body.reflectivity = 0.95;
  addWall(made.world, 0, 3.1, 1, 0.2);
  const std::string type =
      "<robot name='two' help='Two lasers.'><body radius_m='0.2' height_m='0.3'/>"
      "<limits speed_max_mps='1' accel_mps2='1' decel_mps2='1' turn_max_degps='90' turn_accel_degps2='90'/>"
      "<arcos subclass='p3dx'/><sensors><odometry/><laser z_m='0.2'/><laser label='rear' x_m='-0.5' z_m='0.2'/>"
      "</sensors></robot>";
  FleetRobot robot = robotOfType({{"two", {"two.xml", type}}}, "two");
  made.fleet.robots.push_back(robot);
  ServedRobots served(std::move(made));
  TcpProgram program(served, served.server->ports()[0]);
  program.open();
  std::string commands;
  for (const std::uint8_t laser : {0, 1}) {
    const auto request = [&](std::uint8_t id, std::uint16_t number) {
      arcos::ByteWriter bytes;
      bytes.add(std::uint8_t{0x3B}).add(number).add(laser);
      commands += arcos::encode(id, bytes.bytes());
    };
    request(command::laser_start, 0);
    request(command::laser_end, 90);
    request(command::laser_resolution, 9000);
    request(command::laser_enable, 2);
  }
  program.send(commands);
  program.step();
  for (const std::uint8_t laser : {0, 1}) {
    const arcos::Packet packet = program.next();
    ASSERT_EQ(packet.id, arcos::packet_type::laser_extended);
    arcos::ByteReader bytes(packet.payload);
    EXPECT_EQ(bytes.take<std::uint16_t>(), 2) << "ahead and to the left";
    bytes.take<std::uint16_t>();
    bytes.take<std::uint8_t>();
    EXPECT_NEAR(bytes.take<std::uint16_t>(), 2000 + 500 * laser, 1);
    EXPECT_EQ(bytes.take<std::uint8_t>(), arcos::kReflector);
    bytes.take<std::uint16_t>();
    EXPECT_NEAR(bytes.take<std::uint16_t>(), 3000, 1);
    EXPECT_EQ(bytes.take<std::uint8_t>(), 0);
    bytes.take<std::uint16_t>();
    EXPECT_EQ(bytes.take<std::uint8_t>(), laser);
  }
}

TEST(ArcosServer, PlacesARobotOnlyWhereItIsFree) {
  ServedRobots served(2);
  TcpProgram program(served, served.server->ports()[0]);
  program.open();
  program.send(arcos::encodeSetPose({5000, 6000, 90}));
  program.step();
  EXPECT_NEAR(served.environment->state().world_from_robot[0].x, 5, 1e-9);
  EXPECT_NEAR(served.environment->state().world_from_robot[0].phi, M_PI / 2, 1e-9);
  program.send(arcos::encodeSetPose({-8000, 100, 0}));  // on the second robot
  program.step();
  EXPECT_NEAR(served.environment->state().world_from_robot[0].x, 5, 1e-9);
  EXPECT_NE(served.log.find("robot P1: cannot be placed at (-8000, 100) mm"), std::string::npos) << served.log;
  program.send(arcos::encode(command::sim_reset));
  program.step();
  EXPECT_NEAR(served.environment->state().world_from_robot[0].x, -10, 1e-9);
}

TEST(ArcosServer, LimitsTheLogLinesThatAProgramCanCause) {
  ServedRobots served(1);
  TcpProgram program(served, served.server->ports()[0]);
  program.open();
  for (int i = 0; i < 5; ++i) {
    std::string messages;
    for (int k = 0; k < 1000; ++k) messages += encodeCommand(command::sim_message, "hello");
    program.send(messages);
    program.step();
  }
  EXPECT_LE(countOf("message: hello", served.log), 60u) << "10 in a second";
  EXPECT_EQ(served.server->clients(), 1u);
}

TEST(ArcosServer, NeedsAsManyPortsAsRobots) {
  ServedRobots served(2);
  ArcosOptions options;
  options.listen = "127.0.0.1:65535";
  EXPECT_THROW(ArcosServer(options, *served.environment, {0, 1}), std::runtime_error);
}

TEST(ArcosServer, NamesAPortThatIsInUse) {
  ServedRobots served(1);
  ArcosOptions options;
  options.listen = "127.0.0.1:" + std::to_string(served.server->ports()[0]);
  try {
    const ArcosServer second(options, *served.environment, {0});
    ADD_FAILURE() << "no error";
  } catch (const std::runtime_error& error) {
    EXPECT_EQ(std::string(error.what()), "cannot listen on " + options.listen +
                                             ": is another program using the port? Name another with --arcos (robosim "
                                             "arcos: -p), or :0 for any");
  }
}

// The programs: a served map, a robot driven over its port and recorded, and errors of arguments.
TEST(ArcosServer, LogsARefusalDuringAFloodOfRequests) {
  ServedRobots served(1);
  TcpProgram program(served, served.server->ports()[0]);
  program.open();
  std::string messages;
  for (int k = 0; k < 1000; ++k) messages += encodeCommand(command::sim_message, "hello");
  program.send(messages);
  program.step();
  TcpProgram second(served, served.server->ports()[0]);
  EXPECT_TRUE(second.isClosed());
  EXPECT_EQ(countOf("robot P1 has a program already", served.log), 1u) << served.log;
}

}  // namespace
}  // namespace robosim
