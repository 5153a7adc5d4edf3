#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <boost/asio.hpp>
#include <gtest/gtest.h>

#include "arcos/protocol/command.h"
#include "arcos/protocol/packet.h"
#include "arcos/protocol/sip.h"
#include "environment/testing/small_world.h"
#include "robots/robot_types.h"
#include "serving/arcos_server.h"
#include "tests/scenarios/wait.h"

namespace robosim {

/// A world with robots of the type p3dx in a row.
inline LoadedWorld rowOfRobots(int robots) {
  LoadedWorld made{emptyWorld(20), {}};
  const FleetRobot type = robotOfType(robotTypesIn({ROBOSIM_SOURCE_DIR "/worlds/robots"}), "p3dx");
  for (int i = 0; i < robots; ++i) {
    FleetRobot robot = type;
    robot.info.name = "P" + std::to_string(i + 1);
    robot.world_from_start = {-10.0 + 2 * i, 0, 0};
    made.fleet.robots.push_back(robot);
  }
  return made;
}

/// The robots of a world, served on ports that the system chooses.
struct ServedRobots {
  explicit ServedRobots(int robots, bool is_factory = false) : ServedRobots(rowOfRobots(robots), is_factory) {}
  /// @param map_file if given: of the world, and programs may load others
  explicit ServedRobots(LoadedWorld world, bool is_factory = false, const std::string& map_file = "") {
    std::vector<std::size_t> indices(world.fleet.robots.size());
    std::iota(indices.begin(), indices.end(), std::size_t{0});
    environment = std::make_unique<Environment>(std::move(world.world), std::move(world.fleet), EnvironmentOptions{});
    ArcosOptions options;
    options.listen = "127.0.0.1:0";
    if (is_factory) options.factory = "p3dx";
    options.factory_most = 1;
    options.map_file = map_file;
    options.may_load_maps = !map_file.empty();
    for (const auto i : indices) {
      if (is_factory) environment->remove(i);
    }
    options.log = [this](const std::string& line) { log += line + '\n'; };
    server = std::make_unique<ArcosServer>(options, *environment, indices);
  }
  void step() {
    server->decide();
    environment->step();
    server->stepped();
  }

  std::string log;
  std::unique_ptr<Environment> environment;
  std::unique_ptr<ArcosServer> server;
};

/// A program: its socket, and the packets that it has received.
class TcpProgram {
 public:
  /// Connects while the server works, because its queue of connections may be full; or while it does not.
  enum class Server { works, waits };
  TcpProgram(ServedRobots& served, int port, Server server = Server::works) : served_(served), socket_(io_) {
    bool is_connected = false;
    socket_.async_connect({boost::asio::ip::address_v4::loopback(), static_cast<std::uint16_t>(port)},
                          [&](const boost::system::error_code& error) {
                            if (error) throw boost::system::system_error(error);
                            is_connected = true;
                          });
    waitUntil("the program is connected", [&] {
      if (server == Server::works) served_.server->poll();
      io_.poll();
      return is_connected;
    });
    socket_.non_blocking(true);
    socket_.set_option(
        boost::asio::ip::tcp::no_delay(true));  // a command is not held back until an earlier one is acknowledged
  }
  void send(const std::string& bytes) { boost::asio::write(socket_, boost::asio::buffer(bytes)); }
  /// Lets the server work until a packet arrives. @return an empty one when the server has closed the connection
  arcos::Packet next() {
    std::optional<arcos::Packet> packet;
    waitUntil("a packet arrives", [&] {
      served_.server->poll();
      receive();
      packet = reader_.next();
      return packet || is_closed_;
    });
    return packet.value_or(arcos::Packet{});
  }
  bool isClosed() {
    waitUntil("the server closes the connection", [&] {
      served_.server->poll();
      receive();
      return is_closed_;
    });
    return is_closed_;
  }
  /// Whether the server has closed the connection before.
  bool hasEnded() {
    receive();
    return is_closed_;
  }
  void open() {
    for (const auto id : {arcos::command::sync0, arcos::command::sync1, arcos::command::sync2}) {
      send(arcos::encodeCommand(id));
      EXPECT_EQ(next().id, id);
    }
    send(arcos::encodeCommand(arcos::command::open, 1) + arcos::encodeCommand(arcos::command::config, 1));
    EXPECT_EQ(next().id, arcos::packet_type::config);
  }
  /// The SIP of the next step.
  arcos::Sip step() {
    served_.step();
    for (;;) {
      const auto packet = next();
      if (const auto sip = arcos::decodeSip(packet)) return *sip;
      if (is_closed_) return {};
    }
  }
  void close() { socket_.close(); }

 private:
  void receive() {
    std::array<char, 4096> bytes;
    boost::system::error_code error;
    const std::size_t size = socket_.read_some(boost::asio::buffer(bytes), error);
    reader_.add({bytes.data(), size});
    is_closed_ = is_closed_ || (error && error != boost::asio::error::would_block);
  }

  ServedRobots& served_;
  boost::asio::io_context io_;
  boost::asio::ip::tcp::socket socket_;
  arcos::PacketReader reader_;
  bool is_closed_ = false;
};

}  // namespace robosim
