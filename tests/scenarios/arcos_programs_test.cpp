// `robosim arcos` with programs that connect to it: their runs, recordings and arguments.
#include <array>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <boost/asio.hpp>
#include <gtest/gtest.h>

#include "arcos/client/arcos_client.h"
#include "arcos/client/open_channel.h"
#include "arcos/protocol/bytes.h"
#include "arcos/protocol/camera_messages.h"
#include "arcos/protocol/command.h"
#include "arcos/protocol/packet.h"
#include "arcos/protocol/simulator_packets.h"
#include "arcos/protocol/sip.h"
#include "tests/scenarios/program.h"
#include "tests/scenarios/wait.h"

namespace robosim {
namespace {

namespace command = arcos::command;
using arcos::encodeCommand;
using boost::asio::ip::tcp;

/// The address that a server announces after this text, at a port that the system has chosen: "127.0.0.1:41234".
std::string announcedAfter(const std::string& text, StartedProgram& server) {
  server.waitForError(text);
  const std::string log = server.error();
  const auto at = log.find(text) + text.size();
  return log.substr(at, log.find('\n', at) - at);
}

/// Connects to such an address.
void connectTo(const std::string& address, tcp::socket& socket) {
  const int port = std::stoi(address.substr(address.rfind(':') + 1));
  socket.connect({boost::asio::ip::address_v4::loopback(), static_cast<std::uint16_t>(port)});
}

TEST(ArcosPrograms, OnAMapAreRepeatedFromTheRecordingAndTheMap) {
  const auto rawlog = emptyFolder() / "run.rawlog";
  StartedProgram server({"arcos", "maps/office.map", "-r", "p3dx", "-r", "p3at:Tom", "--port", "0", "--listen",
                         "127.0.0.1:0", "--speed", "20", "--record", rawlog.string()});
  const std::string address = announcedAfter("robot Tom (p3at) for ARCOS programs on ", server);
  StartedProgram robot({"robot", "--arcos", "tcp:" + address, "--controller", "wander"});
  robot.waitForError("connected to MobileSim (p3at)");
  robot.interrupt();
  EXPECT_EQ(robot.wait().exit_code, 0);
  server.interrupt();
  EXPECT_EQ(server.wait().exit_code, 0);
  const Ended check = runProgram("replay --check maps/office.map " + quoted(rawlog));
  EXPECT_EQ(check.exit_code, 0) << check.err;
  EXPECT_TRUE(check.out.starts_with("The same run: ")) << check.out;
}

TEST(ArcosPrograms, LoadMapsThatLieBesideTheOneInUse) {
  const auto folder = emptyFolder();
  for (const char* name : {"a.map", "b.map"}) {
    std::filesystem::copy_file(ROBOSIM_SOURCE_DIR "/maps/office.map", folder / name);
  }
  std::ofstream(folder / "no.map") << "2D-Map\nLINES\n1 2 3\n";
  StartedProgram server(
      {"arcos", (folder / "a.map").string(), "--port", "0", "--listen", "127.0.0.1:0", "--speed", "20"});
  const std::string address = announcedAfter("robot Robot1 (p3dx) for ARCOS programs on ", server);
  const auto channel = openChannel("tcp:" + address);
  ArcosClient client;
  arcos::PacketReader reader;
  const auto receive = [&] {
    const std::string bytes = channel->read(std::chrono::milliseconds(10));
    reader.add(bytes);
    if (const auto answer = client.receive(bytes, channel->now()); !answer.empty()) channel->write(answer);
  };
  waitUntil("the session is open", [&] {
    receive();
    return client.isReady();
  });
  const auto answer_to = [&](const std::string& file) {
    arcos::ByteWriter request;
    request.add(std::uint8_t{0x2B}).add(arcos::sim_operation::load_map);
    request.add(static_cast<std::uint16_t>(file.size())).addText(file);
    channel->write(arcos::encode(command::sim_control, request.bytes()));
    std::string answer;
    waitUntil("the answer arrives", [&] {
      receive();
      while (const auto packet = reader.next()) {
        if (packet->id != arcos::packet_type::sim_map) continue;
        arcos::ByteReader bytes(packet->payload);
        bytes.take<std::uint8_t>();
        answer = bytes.take<std::uint8_t>() != 0 ? "loaded " : "not loaded ";
        answer += bytes.takeText();
      }
      return !answer.empty();
    });
    return answer;
  };
  EXPECT_EQ(answer_to("b.map"), "loaded b.map");
  EXPECT_EQ(answer_to("none.map"), "not loaded b.map");
  EXPECT_EQ(answer_to("no.map"), "not loaded b.map");
  EXPECT_EQ(answer_to("lab.yaml"), "loaded lab.yaml") << "of the maps of RoboSim";
  const std::uint64_t before = client.sips();
  waitUntil("the session continues", [&] {
    receive();
    return client.sips() > before + 5;
  });
  server.interrupt();
  const Ended ended = server.wait();
  EXPECT_EQ(ended.exit_code, 0);
  EXPECT_NE(ended.err.find("the map none.map is not loaded: there is no such file beside the map in use"),
            std::string::npos)
      << ended.err;
  EXPECT_NE(ended.err.find("no.map:3: '1 2 3' is not a wall"), std::string::npos) << ended.err;
  EXPECT_NE((ended.out + ended.err).find("ended by an ARCOS program, which has loaded another map"), std::string::npos)
      << ended.out;
}

TEST(ArcosPrograms, EachGetARobotThatIsAddedForThemAndAreRepeatedFromTheRecording) {
  const auto rawlog = emptyFolder() / "run.rawlog";
  StartedProgram server({"arcos", "maps/office.map", "-R", "p3dx:3", "--port", "0", "--listen", "127.0.0.1:0",
                         "--speed", "20", "--record", rawlog.string()});
  const std::string address = announcedAfter("up to 3 robots, one for each ARCOS program on ", server);
  std::vector<std::unique_ptr<StartedProgram>> programs;
  for (const char* name : {"Robot1", "Robot2", "Robot3"}) {
    programs.push_back(std::make_unique<StartedProgram>(
        std::vector<std::string>{"robot", "--arcos", "tcp:" + address, "--controller", "wander"}));
    server.waitForError(std::string("robot ") + name + ": connected");
  }
  StartedProgram fourth({"robot", "--arcos", "tcp:" + address, "--controller", "wander"});
  server.waitForError("all 3 robots have a program or cannot enter");
  EXPECT_NE(fourth.wait().exit_code, 0);
  for (const auto& program : programs) {
    program->interrupt();
    EXPECT_EQ(program->wait().exit_code, 0);
  }
  StartedProgram next({"robot", "--arcos", "tcp:" + address, "--controller", "wander"});
  next.waitForError("connected to MobileSim (p3dx)");
  next.interrupt();
  EXPECT_EQ(next.wait().exit_code, 0);
  server.interrupt();
  EXPECT_EQ(server.wait().exit_code, 0);
  const Ended check = runProgram("replay --check maps/office.map " + quoted(rawlog));
  EXPECT_EQ(check.exit_code, 0) << check.err;
  EXPECT_TRUE(check.out.starts_with("The same run: ")) << check.out;
}

TEST(ArcosPrograms, DriveARobotOfAServedMapByAControllerOverItsPort) {
  const auto folder = emptyFolder();
  StartedProgram server({"arcos", "maps/office.map", "--port", "0", "--listen", "127.0.0.1:0"});
  const std::string address = announcedAfter("robot Robot1 (p3dx) for ARCOS programs on ", server);
  StartedProgram robot({"robot", "--arcos", "tcp:" + address, "--controller", "wander", "--record",
                        (folder / "run.rawlog").string(), "--arcos-log", (folder / "arcos.log").string()});
  robot.waitForError("connected to MobileSim (p3dx)");
  waitUntil("some cycles are logged", [&] { return textOf(folder / "arcos.log").size() > 50000; });
  robot.interrupt();
  const Ended ended = robot.wait();
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_NE(ended.out.find("drove for "), std::string::npos);
  server.interrupt();
  EXPECT_EQ(server.wait().exit_code, 0);
  // The recording ends with the standing robot: the last column is the turn rate, recorded as 1e-06 at
  // rest, the one before the speed.
  const Ended odometry =
      runProgram("replay --print --csv --robot robot --sensor odometry " + quoted(folder / "run.rawlog"));
  EXPECT_EQ(odometry.exit_code, 0) << odometry.err;
  EXPECT_TRUE(odometry.out.ends_with(",0,1e-06,0\n")) << odometry.out.substr(odometry.out.size() - 200);
  const Ended replay = runProgram("robot --arcos replay:" + quoted(folder / "arcos.log") + " --controller wander");
  EXPECT_EQ(replay.exit_code, 0) << replay.err;
  // The log also has the cycles in which the robot came to rest at the end.
  const auto cycles = [](const std::string& text) { return std::stoi(text.substr(std::string("drove for ").size())); };
  EXPECT_GE(cycles(replay.out), cycles(ended.out));
}

TEST(ArcosPrograms, GetRobotsOfTheirOwnInARunThatCanBeRepeated) {
  const auto folder = emptyFolder();
  const std::string recording = (folder / "run.rawlog").string();
  StartedProgram server(
      {"arcos", "maps/office.map", "-R", "p3dx:3", "--port", "0", "--listen", "127.0.0.1:0", "--record", recording});
  const std::string address = announcedAfter("up to 3 robots, one for each ARCOS program on ", server);
  const auto start = [&](const std::string& name) {
    auto robot = std::make_unique<StartedProgram>(std::vector<std::string>{
        "robot", "--arcos", "tcp:" + address, "--controller", "wander", "--arcos-log", (folder / name).string()});
    robot->waitForError("connected to MobileSim (p3dx)");
    return robot;
  };
  const auto end = [&](StartedProgram& robot, const std::string& name) {
    waitUntil("some cycles are logged", [&] { return textOf(folder / name).size() > 10000; });
    robot.interrupt();
    EXPECT_EQ(robot.wait().exit_code, 0);
  };
  const auto first = start("first"), second = start("second");
  end(*first, "first");
  server.waitForError(": disconnected");
  const auto third = start("third");
  end(*third, "third");
  end(*second, "second");
  server.interrupt();
  EXPECT_EQ(server.wait().exit_code, 0);
  const Ended check = runProgram("replay " + quoted(folder / "run.rawlog") + " --observer coverage");
  EXPECT_EQ(check.exit_code, 0) << check.out << check.err;
  EXPECT_NE(check.out.find("The same run"), std::string::npos) << check.out;
}

// The program drives 0.2 m and is placed back at its start.
TEST(ArcosPrograms, ThatPlaceTheirRobotMakeARunThatIsRepeated) {
  const auto rawlog = emptyFolder() / "run.rawlog";
  StartedProgram server({"arcos", "maps/office.map", "--port", "0", "--listen", "127.0.0.1:0", "--speed", "5",
                         "--record", rawlog.string()});
  const std::string address = announcedAfter("robot Robot1 (p3dx) for ARCOS programs on ", server);
  boost::asio::io_context io;
  tcp::socket socket(io);
  connectTo(address, socket);
  arcos::PacketReader reader;
  const auto send = [&](const std::string& bytes) { boost::asio::write(socket, boost::asio::buffer(bytes)); };
  const auto next = [&] {
    for (;;) {
      if (auto packet = reader.next()) return *packet;
      std::array<char, 4096> bytes;
      reader.add({bytes.data(), socket.read_some(boost::asio::buffer(bytes))});
    }
  };
  for (const auto id : {command::sync0, command::sync1, command::sync2}) {
    send(encodeCommand(id));
    next();
  }
  send(encodeCommand(command::open, 1) + encodeCommand(command::vel, 200));
  for (std::optional<arcos::Sip> sip; !sip || sip->x < 400;) {  // units of 0.485 mm
    sip = arcos::decodeSip(next());
    send(encodeCommand(command::pulse));  // else it stops after 2 s, which a slow machine may take
  }
  send(arcos::encode(command::sim_reset) + encodeCommand(command::stop));
  for (std::optional<arcos::Sip> sip; !sip || sip->is_moving;) sip = arcos::decodeSip(next());
  socket.close();
  server.interrupt();
  const Ended ended = server.wait();
  EXPECT_NE(ended.out.find("interventions  1\n"), std::string::npos) << ended.out;
  const Ended check = runProgram("replay --check maps/office.map " + quoted(rawlog));
  EXPECT_EQ(check.exit_code, 0) << check.out << check.err;
  EXPECT_TRUE(check.out.starts_with("The same run: ")) << check.out;
}

// The program turns the camera 45° to the right, and asks where it is until it is there.
TEST(ArcosPrograms, ThatTurnACameraMakeARunThatIsRepeated) {
  const auto rawlog = emptyFolder() / "run.rawlog";
  StartedProgram server({"arcos", "maps/office.map", "-r", "p3dx_ptz", "--port", "0", "--listen", "127.0.0.1:0",
                         "--speed", "5", "--record", rawlog.string()});
  const std::string address = announcedAfter("robot Robot1 (p3dx_ptz) for ARCOS programs on ", server);
  boost::asio::io_context io;
  tcp::socket socket(io);
  connectTo(address, socket);
  arcos::PacketReader reader;
  const auto send = [&](const std::string& bytes) { boost::asio::write(socket, boost::asio::buffer(bytes)); };
  const auto next = [&] {
    for (;;) {
      if (auto packet = reader.next()) return *packet;
      std::array<char, 4096> bytes;
      reader.add({bytes.data(), socket.read_some(boost::asio::buffer(bytes))});
    }
  };
  const auto next_of = [&](std::uint8_t type) {
    for (;;) {
      if (const auto packet = next(); packet.id == type) return packet.payload;
    }
  };
  const auto ask = [&](std::uint8_t id, const std::string& parameters, int bytes) {
    send(encodeCommand(command::getaux, bytes) + encodeCommand(command::tty2, arcos::vcc4::encode({id, parameters})));
    return next_of(arcos::packet_type::aux);
  };
  for (const auto id : {command::sync0, command::sync1, command::sync2}) {
    send(encodeCommand(id));
    next();
  }
  send(encodeCommand(command::open, 1));
  namespace camera = arcos::vcc4::command;
  ask(camera::control, "0", 6);
  ask(camera::turn_to, "81908000", 6);
  ask(camera::zoom_to, "00C8", 6);
  while (ask(camera::direction_request, "", 14).substr(5, 8) != "81908000") next_of(arcos::packet_type::sip_standing);
  socket.close();
  server.interrupt();
  EXPECT_EQ(server.wait().exit_code, 0);
  const Ended head = runProgram("replay --print --csv --robot Robot1 --sensor ptz " + quoted(rawlog));
  EXPECT_EQ(head.exit_code, 0) << head.err;
  EXPECT_NE(head.out.find("-0.785398"), std::string::npos) << head.out.substr(0, 500);
  const Ended check = runProgram("replay --check maps/office.map " + quoted(rawlog));
  EXPECT_EQ(check.exit_code, 0) << check.out << check.err;
  EXPECT_TRUE(check.out.starts_with("The same run: ")) << check.out;
}

TEST(ArcosLog, OfAnotherKindIsRefusedWithoutReadingAllOfIt) {
  const auto error_of = [](const std::string& file) {
    const Ended ended = runProgram("robot --controller wander --arcos replay:" + file);
    EXPECT_EQ(ended.exit_code, 1) << file;
    return ended.err;
  };
  const std::string device = error_of("/dev/zero");
  EXPECT_NE(device.find("/dev/zero: "), std::string::npos) << device;
  EXPECT_NE(device.find("device"), std::string::npos) << device;
  const auto file = emptyFolder() / "long.log";
  std::ofstream(file) << "RoboSim ARCOS log 1\n";
  std::filesystem::resize_file(file, std::uintmax_t{1} << 33);  // a line of 8 GiB that takes no space on the disk
  const std::string line = error_of(file.string());
  EXPECT_NE(line.find("long.log:2: is no line of an ARCOS log"), std::string::npos) << line;
  const std::string first = error_of("/usr/bin/env");
  EXPECT_NE(first.find("/usr/bin/env:1: is no log of --arcos-log"), std::string::npos) << first;
}

TEST(ArcosPrograms, DriveRobotsInPlaceOfAControllerOfTheRunWithArcosAll) {
  const std::vector<std::string> serve{"serve",   "worlds/open_house.xml", "--listen",     "127.0.0.1:0",
                                       "--arcos", "127.0.0.1:0",           "--controller", "wander"};
  StartedProgram none(serve);
  none.waitForError("no robots for ARCOS programs: --controller drives them all; leave it out, or add --arcos-all");
  auto with_all = serve;
  with_all.emplace_back("--arcos-all");
  StartedProgram all(with_all);
  const std::string address = announcedAfter("for ARCOS programs on ", all);
  StartedProgram robot({"robot", "--arcos", "tcp:" + address, "--controller", "still"});
  robot.waitForError("connected to MobileSim");
}

TEST(ArcosPrograms, ExplainWrongArguments) {
  const auto error_of = [](const std::string& arguments) { return runProgram(arguments).err; };
  const auto contains = [](const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
  };
  contains(error_of("serve worlds/open_house.xml --arcos 0.0.0.0:18412"), "ARCOS has neither passwords nor encryption");
  contains(error_of("serve worlds/open_house.xml --arcos 18412 --pace lockstep"), "--arcos needs --pace realtime");
  contains(error_of("serve worlds/open_house.xml --arcos-factory p3dx"),
           "--arcos-factory: has no effect without --arcos");
  contains(error_of("serve worlds/open_house.xml --arcos 18412 --arcos-factory p3dx:x"), "optionally with a number");
  contains(error_of("arcos maps/office.map -r nothing"), "there is no robot type 'nothing'");
  contains(error_of("arcos maps/office.map -r p3dx:"), "must be a robot type, optionally with a name");
  contains(error_of("arcos maps/office.map --start x"), "in millimetres and degrees");
  contains(error_of("arcos maps/office.map -R p3dx --start 1,2"), "--start is for the first robot of -r");
  contains(error_of("serve worlds/open_house.xml --arcos 18412 --step 0.04"), "--step must divide the cycle of ARCOS");
  contains(error_of("robot --arcos tcp:127.0.0.1:1"), "--arcos needs --controller");
  contains(error_of("robot --arcos tcp:127.0.0.1:1 --controller wander"), "Connection refused");
  contains(error_of("robot"), "NAME is required");
}

}  // namespace
}  // namespace robosim
