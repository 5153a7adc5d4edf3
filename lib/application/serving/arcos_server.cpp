#include "serving/arcos_server.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <utility>

#include <boost/asio.hpp>
#include <fcntl.h>
#include <unistd.h>

#include "arcos/board/arcos_board.h"
#include "arcos/board/arcos_session.h"
#include "arcos/protocol/parameters.h"
#include "base/log_limiter.h"
#include "control/robot.h"
#include "environment/local_hardware.h"
#include "net/host_port.h"
#include "serving/arcos_connection.h"
#include "serving/arcos_lasers.h"

namespace robosim {
namespace {

namespace asio = boost::asio;
using asio::ip::tcp;
using Clock = ArcosSession::Clock;

constexpr double kRadiansPerDegree = M_PI / 180;
constexpr double kMm = 1000;
/// ARIA's programs end after 8 s without a SIP, so that SIPs are sent while the run is paused, too.
constexpr std::chrono::seconds kIdleCycle{1};
constexpr std::chrono::milliseconds kAcceptPause{100};
/// Events handled in one poll: connections that are accepted, and reads of up to 4 KiB.
constexpr std::size_t kMinEventsPerPoll = 16;

/// A robot of the run, its board, and the program that drives it.
struct ServedRobot final : Simulator {
  ServedRobot(Environment& the_environment, std::size_t robot_index, const ArcosOptions& options,
              std::function<void(const std::string&)> log)
      : environment(the_environment),
        index(robot_index),
        speed(options.speed),
        write_log(std::move(log)),
        hardware(the_environment, robot_index),
        robot(hardware),
        board(robot, *the_environment.fleet().robots[robot_index].model->arcos) {}

  const std::string& name() const { return robot.name(); }

  arcos::SimStat stat() const override {
    const double period_ms = environment.time().period_s * 1000;
    const auto& pose = environment.state().world_from_robot[index];
    const auto mm = [](double length_m) { return static_cast<std::int32_t>(std::lround(length_m * kMm)); };
    return {.interval_ms = static_cast<std::uint16_t>(std::lround(period_ms)),
            .desired_interval_ms = static_cast<std::uint16_t>(std::clamp(std::round(period_ms / speed), 0.0, 65535.0)),
            .measured_interval_ms = measured_interval_ms,
            .x_mm = mm(pose.x),
            .y_mm = mm(pose.y),
            .z_mm = 0,
            .heading_deg = static_cast<std::int32_t>(std::lround(pose.phi / kRadiansPerDegree))};
  }
  void setTruePose(const arcos::SimPose& pose) override {
    placeAt({pose.x_mm / kMm, pose.y_mm / kMm, pose.heading_deg * kRadiansPerDegree});
  }
  void resetTruePose() override { placeAt(environment.fleet().robots[index].world_from_start); }
  std::span<const std::uint16_t> scan() const override { return scan_mm; }
  std::string mapFile() const override { return environment.world().name; }
  void log(const std::string& text) override { write_log("robot " + name() + ": " + text); }
  bool isAbsent() const { return environment.state().activity[index] == Activity::absent; }
  /// Places an absent robot at its start. @return false if that is not free. A robot that has left in this step stays
  /// absent for one, so that a recording shows that it has left.
  bool enter() {
    return isAbsent() && left_at_step != environment.time().step &&
           environment.place(index, environment.fleet().robots[index].world_from_start);
  }
  void leave() {
    environment.remove(index);
    left_at_step = environment.time().step;
  }

  void placeAt(const mrpt::math::TPose2D& pose) {
    if (environment.place(index, pose)) {
      if (connection) connection->session().noteMoved();
    } else {
      log("cannot be placed at (" + std::to_string(std::lround(pose.x * kMm)) + ", " +
          std::to_string(std::lround(pose.y * kMm)) + ") mm: it would overlap something, or the surface's edge");
    }
  }

  Environment& environment;
  std::size_t index;
  double speed;
  std::function<void(const std::string&)> write_log;
  LocalHardware hardware;
  Robot robot;
  ArcosBoard board;
  std::shared_ptr<ArcosConnection> connection;  ///< null without a program
  std::optional<std::uint64_t> left_at_step;
  std::vector<std::uint16_t> scan_mm;
  std::uint16_t measured_interval_ms = 0;
};

tcp::endpoint endpointOf(const std::string& listen) {
  const HostPort at = HostPort::of(hostAndPort(listen));
  const std::string host = at.host == "localhost" ? "127.0.0.1" : at.host;
  boost::system::error_code error;
  const auto address = asio::ip::make_address(host, error);
  if (error) throw std::runtime_error("--arcos " + listen + ": '" + at.host + "' is no IP address");
  return {address, static_cast<std::uint16_t>(std::stoi(at.port))};
}

tcp::acceptor openAcceptor(asio::io_context& io, const tcp::endpoint& at) {
  tcp::acceptor acceptor(io);
  try {
    acceptor.open(at.protocol());
    acceptor.set_option(tcp::acceptor::reuse_address(true));
    acceptor.bind(at);
    acceptor.listen();
  } catch (const boost::system::system_error& error) {
    const std::string address = withPort(at.address().to_string() + ":0", at.port());
    throw std::runtime_error("cannot serve ARCOS programs at " + address + ": " + error.code().message() +
                             "; choose another port with --arcos");
  }
  return acceptor;
}

/// The same listening socket again.
tcp::acceptor sharedAcceptor(asio::io_context& io, tcp::acceptor& other) {
  const int descriptor = fcntl(other.native_handle(), F_DUPFD_CLOEXEC, 0);
  if (descriptor < 0) {
    throw std::runtime_error(std::string("cannot share a port for ARCOS programs: ") + std::strerror(errno) +
                             "; raise the limit of open files (ulimit -n)");
  }
  tcp::acceptor acceptor(io);
  boost::system::error_code error;
  acceptor.assign(other.local_endpoint().protocol(), descriptor, error);
  if (error) {
    close(descriptor);
    throw boost::system::system_error(error);
  }
  return acceptor;
}

}  // namespace

struct ArcosServer::Impl {
  LogLimiter limited_log;  ///< of lines that programs can cause
  Clock::time_point last_report = Clock::now();
  ArcosOptions options;
  Environment& environment;
  asio::io_context io;
  std::vector<std::unique_ptr<ServedRobot>> robots;
  std::vector<tcp::acceptor> acceptors;  ///< one per robot, or one for all
  std::vector<std::size_t> paused_acceptors;
  bool accepts_programs = false;
  Clock::time_point accept_again;
  ArcosLasers lasers;
  std::uint64_t steps_per_cycle;
  std::uint64_t steps = 0;  ///< since the last cycle
  Clock::time_point last_cycle = Clock::now(), last_step = Clock::now();

  Impl(const ArcosOptions& the_options, Environment& the_environment, const std::vector<std::size_t>& indices,
       Impl* previous)
      : limited_log(the_options.log),
        options(the_options),
        environment(the_environment),
        lasers(the_environment),
        steps_per_cycle(
            static_cast<std::uint64_t>(std::max(1.0, std::round(arcos::kCycle_s / the_environment.time().period_s)))) {
    // A kind for each source, so that a flood of one does not hide the others.
    options.log = [this](const std::string& line) { limited_log.write("ARCOS programs", line); };
    const auto log_request = [this](const std::string& line) { limited_log.write("requests of ARCOS programs", line); };
    for (const auto index : indices) {
      robots.push_back(std::make_unique<ServedRobot>(environment, index, options, log_request));
    }
    tcp::endpoint at = endpointOf(options.listen);
    const bool is_fixed = at.port() != 0;
    const std::size_t ports = options.is_factory ? std::min<std::size_t>(1, robots.size()) : robots.size();
    if (at.port() + ports > 65536) {
      throw std::runtime_error(
          "--arcos " + options.listen + ": " + std::to_string(ports) +
          " robots need as many ports from this one on, and the last port is 65535; choose a lower one");
    }
    for (std::size_t i = 0; i < ports; ++i) {
      const bool is_open = is_fixed && previous && i < previous->acceptors.size();
      acceptors.push_back(is_open ? sharedAcceptor(io, previous->acceptors[i]) : openAcceptor(io, at));
      if (is_fixed) at.port(static_cast<std::uint16_t>(at.port() + 1));
    }
  }

  void accept(std::size_t i) {
    acceptors[i].async_accept([this, i](const boost::system::error_code& error, tcp::socket socket) {
      if (error == asio::error::operation_aborted) return;
      if (error) {  // of this machine, such as no free descriptor: tries again later
        options.log("cannot accept a program: " + error.message());
        paused_acceptors.push_back(i);
        accept_again = Clock::now() + kAcceptPause;
        return;
      }
      admit(i, std::move(socket));
      accept(i);
    });
  }

  /// The robot for a program that connects to a port; of a factory, one that enters for it. Null if there is none.
  ServedRobot* robotFor(std::size_t port) {
    if (!options.is_factory) return robots[port]->connection ? nullptr : robots[port].get();
    const auto found = std::find_if(robots.begin(), robots.end(), [](const auto& robot) { return robot->enter(); });
    return found == robots.end() ? nullptr : found->get();
  }

  void admit(std::size_t port, tcp::socket socket) {
    dropEnded();  // the program before may just have left
    boost::system::error_code ignored;
    const auto peer_endpoint = socket.remote_endpoint(ignored);
    const std::string peer = withPort(peer_endpoint.address().to_string(ignored) + ":0", peer_endpoint.port());
    ServedRobot* robot = robotFor(port);
    if (!robot) {
      limited_log.write("refused ARCOS programs",
                        "refused " + peer + ": " +
                            (options.is_factory ? "all " + std::to_string(robots.size()) +
                                                      " robots have a program, or their starts are not free; give "
                                                      "--arcos-factory a greater number"
                                                : "robot " + robots[port]->name() + " has a program already"));
      return;  // closes the socket
    }
    robot->connection = std::make_shared<ArcosConnection>(std::move(socket), peer, robot->board, *robot);
    robot->connection->start();
    options.log("robot " + robot->name() + ": connected, " + peer);
  }

  void dropEnded() {
    for (const auto& robot : robots) {
      if (!robot->connection || robot->connection->endReason().empty()) continue;
      options.log("robot " + robot->name() + ": disconnected " + robot->connection->peer() + ": " +
                  robot->connection->endReason());
      robot->connection->close();
      robot->connection.reset();
      robot->board.endSession();
      if (options.is_factory) robot->leave();
    }
  }

  void poll() {
    if (!std::exchange(accepts_programs, true)) {
      for (std::size_t i = 0; i < acceptors.size(); ++i) accept(i);
    }
    // Not until no event is left: floods and programs that reconnect at once would delay the step.
    const std::size_t max_events = std::max(kMinEventsPerPoll, 4 * robots.size());
    for (std::size_t n = 0; n < max_events && io.poll_one() > 0; ++n) {
    }
    const auto now = Clock::now();
    if (!paused_acceptors.empty() && now >= accept_again) {
      for (const auto i : std::exchange(paused_acceptors, {})) accept(i);
    }
    for (const auto& robot : robots) {
      if (robot->connection) robot->connection->poll(now);
    }
    dropEnded();
    if (now - last_report > std::chrono::seconds(1)) {
      last_report = now;
      limited_log.reportSuppressed();
    }
    if (now - last_cycle > kIdleCycle) sendCycle(now);
  }

  void decide() {
    poll();
    const auto now = Clock::now();
    for (const auto& robot : robots) {
      if (robot->connection) {
        robot->connection->session().beforeStep(now);
      } else if (!robot->isAbsent()) {
        robot->board.update(false);
      }
    }
  }

  void stepped() {
    const auto now = Clock::now();
    const auto interval_ms = std::chrono::duration_cast<std::chrono::milliseconds>(now - last_step).count();
    last_step = now;
    for (const auto& robot : robots) {
      robot->measured_interval_ms = static_cast<std::uint16_t>(std::min<std::int64_t>(interval_ms, 65535));
    }
    if (++steps >= steps_per_cycle) sendCycle(now);
  }

  void sendCycle(Clock::time_point now) {
    steps = 0;
    last_cycle = now;
    std::vector<ArcosLasers::Request> requests;
    for (const auto& robot : robots) {
      if (!robot->connection || !robot->connection->session().isOpen()) continue;
      const arcos::LaserRequest& laser = robot->connection->session().laser();
      if (laser.form == arcos::LaserRequest::Form::off) continue;
      requests.push_back({static_cast<std::uint32_t>(robot->index), laser, &robot->scan_mm});
    }
    lasers.measure(requests);
    for (const auto& robot : robots) {
      if (robot->connection) robot->connection->sendCycle();
    }
  }
};

ArcosServer::ArcosServer(const ArcosOptions& options, Environment& environment, const std::vector<std::size_t>& robots,
                         const ArcosServer* previous)
    : impl_(std::make_unique<Impl>(options, environment, robots, previous ? previous->impl_.get() : nullptr)) {}

ArcosServer::~ArcosServer() = default;

std::vector<int> ArcosServer::ports() const {
  std::vector<int> ports;
  for (std::size_t i = 0; i < impl_->robots.size(); ++i) {
    ports.push_back(impl_->acceptors[impl_->options.is_factory ? 0 : i].local_endpoint().port());
  }
  return ports;
}

std::size_t ArcosServer::clients() const {
  return static_cast<std::size_t>(
      std::count_if(impl_->robots.begin(), impl_->robots.end(), [](const auto& robot) { return robot->connection; }));
}

void ArcosServer::poll() { impl_->poll(); }
void ArcosServer::decide() { impl_->decide(); }
void ArcosServer::stepped() { impl_->stepped(); }

bool isForArcos(const FleetRobot& robot, const ArcosOptions& options) {
  return robot.model->arcos && (options.has_all || robot.controller.empty());
}

}  // namespace robosim
