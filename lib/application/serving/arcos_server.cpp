#include "serving/arcos_server.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <utility>

#include "arcos/board/arcos_board.h"
#include "arcos/board/arcos_session.h"
#include "arcos/protocol/parameters.h"
#include "base/angle_units.h"
#include "base/log_limiter.h"
#include "base/seconds.h"
#include "control/robot.h"
#include "environment/local_hardware.h"
#include "hardware/gnss_fix.h"
#include "net/connection_acceptor.h"
#include "net/host_port.h"
#include "net/processor_budget.h"
#include "serving/arcos_connection.h"
#include "serving/arcos_factory.h"
#include "serving/arcos_lasers.h"
#include "serving/new_arcos_connections.h"
#include "world/georeference.h"

namespace robosim {
namespace {

using Clock = ArcosSession::Clock;

constexpr double kMm = 1000;
/// ARIA's programs end after 8 s without a SIP, so that SIPs are sent while the run is paused, too.
constexpr std::chrono::seconds kIdleCycle{1};
/// Floods and programs that reconnect at once must not delay the step: what is accepted in one poll, and the share of
/// a processor that connections before their handshake use together.
constexpr std::size_t kAcceptsPerPoll = 64;
constexpr double kNewConnectionsShare = 0.2;
constexpr std::chrono::milliseconds kNewConnectionsBurst{20};  ///< of processor time
constexpr int kReadsPerPoll = 4;  ///< of each program that drives a robot, up to 4 KiB each

/// Map that programs have asked for.
struct MapRequest {
  std::string file;
  std::vector<std::size_t> robots;  ///< whose programs await the answer
  bool is_taken = false;            ///< by ArcosServer::takeMapRequest()
};

/// A robot of the run, its board, and the program that drives it.
struct ServedRobot final : Simulator {
  ServedRobot(Environment& the_environment, std::size_t robot_index, const ArcosOptions& options,
              std::optional<MapRequest>& the_map_request, std::function<void(const std::string&)> log)
      : environment(the_environment),
        index(robot_index),
        speed(options.speed),
        may_load_maps(options.may_load_maps),
        map_file(std::filesystem::path(options.map_file).filename().string()),
        map_request(the_map_request),
        write_log(std::move(log)),
        hardware(the_environment, robot_index),
        robot(hardware),
        board(robot, *the_environment.fleet().robots[robot_index].model->arcos) {}

  const std::string& name() const { return robot.name(); }
  const std::string& model() const { return environment.fleet().robots[index].info.type->model; }

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
            .heading_deg = static_cast<std::int32_t>(std::lround(pose.phi / kRadPerDeg)),
            .position = position()};
  }
  /// By the robot's receiver, if it has one, else the true one.
  std::optional<arcos::SimPosition> position() const {
    const auto reference = georeferenceOf(environment.world());
    if (!reference) return std::nullopt;
    GnssFix fix;
    const auto& sensors = *robot.info().sensors;
    const auto receiver = std::find_if(sensors.begin(), sensors.end(), GnssFix::isOf);
    if (receiver != sensors.end()) {
      fix = GnssFix::from(
          std::get<Values>(robot.readings().measurements[static_cast<std::size_t>(receiver - sensors.begin())]));
    } else {
      const auto& pose = environment.state().world_from_robot[index];
      const GeoPosition at = reference->positionOf({pose.x, pose.y}, 0);
      fix = {true, at.latitude_deg, at.longitude_deg, at.altitude_m};
    }
    constexpr double kE7 = 1e7, kCm = 100;
    const auto rounded = [](double value) { return static_cast<std::int32_t>(std::lround(value)); };
    return arcos::SimPosition{fix.is_valid, rounded(fix.latitude_deg * kE7), rounded(fix.longitude_deg * kE7),
                              rounded(fix.altitude_m * kCm)};
  }
  void setTruePose(const arcos::SimPose& pose) override {
    placeAt({pose.x_mm / kMm, pose.y_mm / kMm, pose.heading_deg * kRadPerDeg});
  }
  void resetTruePose() override { placeAt(environment.fleet().robots[index].world_from_start); }
  arcos::Scan scan(std::size_t laser) const override { return scans[laser].view(); }
  std::string mapFile() const override { return map_file.empty() ? environment.world().name : map_file; }
  std::optional<arcos::SimMap> loadMap(const std::string& file) override {
    const arcos::SimMap in_use{.file = mapFile()};
    const std::string name = std::filesystem::path(file).filename().string();
    if (!may_load_maps) {
      log("a map is not loaded for a program, as others use this run: robosim arcos lets programs load maps");
      return in_use;
    }
    if (name.empty() || name == map_file) return in_use;
    if (!map_request) map_request.emplace().file = name;
    if (map_request->file != name) {
      log("the map " + name + " is not loaded: " + map_request->file + " is being loaded");
      return in_use;
    }
    map_request->robots.push_back(index);
    return std::nullopt;
  }
  void log(const std::string& text) override { write_log("robot " + name() + ": " + text); }
  bool isAbsent() const { return environment.state().activity[index] == Activity::absent; }
  /// Places an absent robot at its start. @return false if that is not free. A robot that has left in this step stays
  /// absent for one, so that a recording shows that it has left.
  bool enter() { return isAbsent() && left_at_step != environment.time().step && environment.enter(index); }
  void leave() {
    environment.remove(index);
    left_at_step = environment.time().step;
  }

  void placeAt(const mrpt::math::TPose2D& pose) {
    const std::string fault = environment.apply({"ARCOS program", PlaceBody{name(), pose.x, pose.y, pose.phi}});
    if (fault.empty()) {
      if (connection) connection->session().noteMoved();
    } else {
      log("cannot be placed at (" + std::to_string(std::lround(pose.x * kMm)) + ", " +
          std::to_string(std::lround(pose.y * kMm)) + ") mm: " + fault);
    }
  }

  Environment& environment;
  std::size_t index;
  double speed;
  bool may_load_maps;
  std::string map_file;
  std::optional<MapRequest>& map_request;  ///< of all robots
  std::function<void(const std::string&)> write_log;
  LocalHardware hardware;
  Robot robot;
  ArcosBoard board;
  std::unique_ptr<ArcosConnection> connection;  ///< null without a program
  std::optional<std::uint64_t> left_at_step;
  std::array<ArcosScan, arcos::kLasersMax> scans;
  std::uint16_t measured_interval_ms = 0;
};

using Listener = std::shared_ptr<const ConnectionListener>;

/// The ports of some robots. A port that `previous` has open is shared.
std::vector<Listener> listenersFor(const ArcosOptions& options, std::size_t ports,
                                   const std::vector<Listener>& previous) {
  const std::string first = hostAndPort(options.listen);
  const int first_port = std::stoi(HostPort::of(first).port);
  const bool is_fixed = first_port != 0;
  if (static_cast<std::size_t>(first_port) + ports > 65536) {
    throw std::runtime_error(
        "--arcos " + options.listen + ": " + std::to_string(ports) +
        " robots need as many ports from this one on, and the last port is 65535; choose a lower one");
  }
  std::vector<Listener> listeners;
  for (std::size_t i = 0; i < ports; ++i) {
    const int port = is_fixed ? first_port + static_cast<int>(i) : 0;
    listeners.push_back(is_fixed && i < previous.size() ? previous[i]
                                                        : std::make_shared<const ConnectionListener>(
                                                              withPort(first, port), "--arcos (robosim arcos: -p)"));
  }
  return listeners;
}

}  // namespace

struct ArcosServer::Impl {
  LogLimiter limited_log;  ///< of lines that programs can cause
  Clock::time_point last_report = Clock::now();
  ArcosOptions options;
  Environment& environment;
  std::optional<MapRequest> map_request;
  std::vector<std::unique_ptr<ServedRobot>> robots;
  std::optional<ConnectionAcceptor> acceptor;  ///< of a port per robot, or one for all
  NewArcosConnections new_connections;
  ArcosFactory factory;
  ProcessorBudget budget{kNewConnectionsShare, kNewConnectionsBurst};  ///< of new connections
  ArcosLasers lasers;
  std::uint64_t steps_per_cycle;
  std::uint64_t steps = 0;  ///< since the last cycle
  Clock::time_point last_cycle = Clock::now(), last_step = Clock::now();

  Impl(const ArcosOptions& the_options, Environment& the_environment, const std::vector<std::size_t>& indices,
       Impl* previous)
      : limited_log(the_options.log),
        options(the_options),
        environment(the_environment),
        factory(the_environment, the_options.factory, the_options.isFactory() ? the_options.factory_most - 1 : 0),
        lasers(the_environment),
        steps_per_cycle(
            static_cast<std::uint64_t>(std::max(1.0, std::round(arcos::kCycle_s / the_environment.time().period_s)))) {
    // A kind for each source, so that a flood of one does not hide the others.
    options.log = [this](const std::string& line) { limited_log.write("ARCOS programs", line); };
    addRobots(indices);
    const std::size_t ports = options.isFactory() ? std::min<std::size_t>(1, robots.size()) : robots.size();
    acceptor.emplace(
        listenersFor(options, ports, previous ? previous->acceptor->listeners() : std::vector<Listener>{}),
        ConnectionAcceptor::Options{.pending = "connections without ARCOS's handshake",
                                    .take = [this](const AcceptedConnection& accepted) { return take(accepted); },
                                    .close = [this](ConnectionAcceptor::Number number) { drop(number); }});
  }

  void addRobots(const std::vector<std::size_t>& indices) {
    const auto log_request = [this](const std::string& line) { limited_log.write("requests of ARCOS programs", line); };
    for (const auto index : indices) {
      if (!robots.empty() && robots.back()->index >= index) continue;
      robots.push_back(std::make_unique<ServedRobot>(environment, index, options, map_request, log_request));
    }
  }

  bool isFree(std::size_t port) const {
    if (!options.isFactory()) return !robots[port]->connection;
    return factory.mayAdd() ||
           std::any_of(robots.begin(), robots.end(), [](const auto& robot) { return !robot->connection; });
  }
  /// The robot for a program that has connected to a port; of a factory, one that enters or is added for it. Null if
  /// there is none.
  ServedRobot* robotFor(std::size_t port) {
    if (!options.isFactory()) return robots[port]->connection ? nullptr : robots[port].get();
    // A supervisor may have removed a robot with a program, or placed one without.
    const auto found = std::find_if(robots.begin(), robots.end(), [](const auto& robot) {
      return !robot->connection && (!robot->isAbsent() || robot->enter());
    });
    if (found != robots.end()) return found->get();
    const auto added = factory.add();
    if (!added) return nullptr;
    addRobots({*added});
    return robots.back().get();
  }
  void refuse(const AcceptedConnection& accepted) {
    limited_log.write("refused ARCOS programs",
                      "refused " + toHostAndPort(accepted.peer) + ": " +
                          (options.isFactory() ? "all " + std::to_string(robots.size()) +
                                                     " robots have a program or cannot enter, and no other one can be "
                                                     "added; at most " +
                                                     std::to_string(options.factory_most) + " " + options.factory +
                                                     " come (--arcos-factory), where there is room"
                                               : "robot " + robots[accepted.port]->name() + " has a program already"));
  }

  /// A connection claims a robot by the handshake only, so that others cannot occupy robots.
  bool take(const AcceptedConnection& accepted) {
    if (!isFree(accepted.port)) dropEnded();  // the program before may just have left
    if (!isFree(accepted.port)) {
      refuse(accepted);
      return false;
    }
    new_connections.add(accepted,
                        std::make_unique<ArcosConnection>(accepted, [this, accepted] { return claim(accepted); }));
    return true;
  }
  std::optional<ArcosSession::Robot> claim(const AcceptedConnection& accepted) {
    dropEnded();
    ServedRobot* const robot = robotFor(accepted.port);
    if (!robot) {
      refuse(accepted);
      return std::nullopt;
    }
    acceptor->release(accepted.number);
    robot->connection = new_connections.take(accepted.number);
    options.log("robot " + robot->name() + ": connected, " + robot->connection->peer());
    return ArcosSession::Robot{&robot->board, robot};
  }
  void drop(ConnectionAcceptor::Number number) {
    acceptor->release(number);
    new_connections.take(number);
  }

  void dropEnded() {
    for (const auto& robot : robots) {
      if (!robot->connection || robot->connection->endReason().empty()) continue;
      options.log("robot " + robot->name() + ": disconnected " + robot->connection->peer() + ": " +
                  robot->connection->endReason());
      robot->connection.reset();
      robot->board.endSession();
      if (options.isFactory()) robot->leave();
    }
  }

  /// What is left of a flood is handled in the next polls.
  void pollNewConnections(Clock::time_point now) {
    if (budget.wait(now).count() > 0) return;
    const auto begin = processorTimeOfThread();
    acceptor->accept(kAcceptsPerPoll);
    for (const auto number : new_connections.receive(now)) drop(number);
    budget.spend(processorTimeOfThread() - begin, Clock::now());
  }

  void poll() {
    const auto now = Clock::now();
    for (const auto& robot : robots) {
      for (int i = 0; i < kReadsPerPoll && robot->connection && robot->connection->receive(now); ++i) {
      }
      if (robot->connection) robot->connection->poll(now);
    }
    pollNewConnections(now);
    dropEnded();
    if (now - last_report > std::chrono::seconds(1)) {
      last_report = now;
      for (const auto number : new_connections.poll(now)) drop(number);
      limited_log.reportSuppressed();
    }
    if (now - last_cycle > kIdleCycle) sendCycle(now);
  }

  void refuseMap(const std::string& why) {
    if (!map_request) return;
    const MapRequest request = *std::exchange(map_request, std::nullopt);
    limited_log.write("requests of ARCOS programs", "the map " + request.file + " is not loaded: " + why);
    for (const auto& robot : robots) {
      const bool awaits = std::find(request.robots.begin(), request.robots.end(), robot->index) != request.robots.end();
      if (awaits && robot->connection) robot->connection->send(encode(arcos::SimMap{.file = robot->mapFile()}));
    }
  }

  void takePrograms(Impl& previous) {
    for (std::size_t i = 0; i < previous.robots.size(); ++i) {
      ServedRobot& before = *previous.robots[i];
      if (!before.connection || !before.connection->endReason().empty()) continue;
      ServedRobot* const robot = options.isFactory() ? robotFor(0) : i < robots.size() ? robots[i].get() : nullptr;
      if (!robot || robot->connection || robot->model() != before.model()) {
        options.log("robot " + before.name() + ": disconnected " + before.connection->peer() +
                    ": the map that has been loaded has no place for it");
        continue;
      }
      robot->connection = std::move(before.connection);
      robot->connection->session().continueWith({&robot->board, robot});
      robot->connection->send(encode(arcos::SimMap{.is_loaded = true, .file = robot->mapFile()}));
    }
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
    const auto interval_ms = wholeMilliseconds(now - last_step);
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
      const RobotModel& model = *environment.fleet().robots[robot->index].model;
      for (std::size_t i = 0; i < arcos::kLasersMax; ++i) {
        const arcos::LaserRequest& laser = robot->connection->session().lasers()[i];
        robot->scans[i].ranges_mm.clear();
        if (laser.form == arcos::LaserRequest::Form::off || !ArcosLasers::has(model, i)) continue;
        requests.push_back({static_cast<std::uint32_t>(robot->index), i, laser, &robot->scans[i]});
      }
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

std::optional<std::string> ArcosServer::takeMapRequest() {
  auto& request = impl_->map_request;
  if (!request || std::exchange(request->is_taken, true)) return std::nullopt;
  return request->file;
}

void ArcosServer::refuseMap(const std::string& why) { impl_->refuseMap(why); }
void ArcosServer::takePrograms(ArcosServer& previous) { impl_->takePrograms(*previous.impl_); }

void ArcosServer::addRobots(const std::vector<std::size_t>& robots) { impl_->addRobots(robots); }

std::vector<int> ArcosServer::ports() const {
  std::vector<int> ports;
  for (std::size_t i = 0; i < impl_->robots.size(); ++i) {
    ports.push_back(impl_->acceptor->listeners()[impl_->options.isFactory() ? 0 : i]->port());
  }
  return ports;
}

std::size_t ArcosServer::clients() const {
  return static_cast<std::size_t>(std::count_if(impl_->robots.begin(), impl_->robots.end(),
                                                [](const auto& robot) { return robot->connection != nullptr; }));
}

void ArcosServer::poll() { impl_->poll(); }
void ArcosServer::decide() { impl_->decide(); }
void ArcosServer::stepped() { impl_->stepped(); }

bool isForArcos(const FleetRobot& robot, const ArcosOptions& options, bool has_controller) {
  return (!robot.model || robot.model->arcos) && (options.has_all || (!has_controller && robot.controller->empty()));
}

}  // namespace robosim
