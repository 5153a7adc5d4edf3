#include "server/environment_server.h"

#include <map>
#include <optional>

#include <grpcpp/grpcpp.h>

#include "base/error_list.h"
#include "net/dial.h"
#include "server/geometry_conversation.h"
#include "server/robot_conversation.h"
#include "server/run_switch.h"
#include "server/viewer_conversation.h"

namespace robosim {
namespace {

using Clock = Lobby::Clock;

/// An interrupt wakes nobody, so all waiting is cut into naps.
constexpr std::chrono::milliseconds kNap(50);

Clock::duration seconds(double s) {
  return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(s));
}

}  // namespace

struct EnvironmentServer::Impl {
  Lobby lobby;
  RunSwitch run_switch;
  RobotConversation robots{lobby};
  ViewerConversation viewers{lobby};
  GeometryConversation geometry{lobby};
  std::vector<std::unique_ptr<grpc::Server>> servers;
  std::vector<int> ports;
  std::optional<std::vector<std::string>> waited_for;  ///< robots that had not come yet; nullopt: not asked yet

  Impl(const ServerOptions& options, std::shared_ptr<const Exhibit> exhibit) {
    lobby.log = options.log;
    lobby.step_deadline = options.step_deadline;
    lobby.pace = options.pace;
    lobby.exhibit = std::move(exhibit);
    run_switch.is_paused = options.is_paused;
    run_switch.speed = options.pace == Pace::realtime && options.speed == 0 ? 1 : options.speed;
    show();
    listen(
        {{options.listen.viewers, &viewers}, {options.listen.robots, &robots}, {options.listen.geometry, &geometry}});
  }

  ~Impl() {
    for (const auto& server : servers) server->Shutdown(std::chrono::system_clock::now() + std::chrono::seconds(1));
  }

  void show() {
    waited_for.reset();
    robots.show();
    viewers.show();
    geometry.show();
  }

  /// Has everyone who has come by now take part.
  void admit() {
    robots.admit();
    geometry.admit();
    viewers.tell();
  }

  void sayGoodbye() {
    robots.sayGoodbye();
    viewers.sayGoodbye();
    geometry.sayGoodbye();
  }

  /// A server for each address, with the services that are to be found there.
  void listen(const std::vector<std::pair<std::string, grpc::Service*>>& services) {
    std::map<std::string, std::vector<std::size_t>> at;
    for (std::size_t i = 0; i < services.size(); ++i) at[services[i].first].push_back(i);
    ports.resize(services.size());
    for (const auto& [address, indices] : at) {
      grpc::ServerBuilder builder;
      int port = 0;
      // Without this two environments could share a port unknowingly, and each robot reach either.
      builder.AddChannelArgument(GRPC_ARG_ALLOW_REUSEPORT, 0);
      builder.AddChannelArgument(GRPC_ARG_KEEPALIVE_TIME_MS, kKeepaliveMs);
      // Clients may ask as often; unless told, gRPC would hang up on them for it.
      builder.AddChannelArgument(GRPC_ARG_HTTP2_MIN_RECV_PING_INTERVAL_WITHOUT_DATA_MS, kKeepaliveMs / 2);
      builder.AddChannelArgument(GRPC_ARG_HTTP2_MAX_PINGS_WITHOUT_DATA, 0);
      builder.AddListeningPort(address, grpc::InsecureServerCredentials(), &port);
      for (const auto i : indices) builder.RegisterService(services[i].second);
      auto server = builder.BuildAndStart();
      if (!server || port == 0) {
        throw std::runtime_error("cannot listen on " + address +
                                 ": is another program using the port? Name another with --listen, or :0 for any");
      }
      for (const auto i : indices) ports[i] = port;
      servers.push_back(std::move(server));
    }
  }

  /// Whether all networked robots have been here; says who is missing, each time that changes.
  bool isEveryoneHere() {
    if (waited_for && waited_for->empty()) return true;
    auto missing = robots.notYetHere();
    if (missing == waited_for) return false;
    const std::lock_guard lock(lobby.mutex);
    if (!missing.empty()) lobby.log("waiting for " + listed(missing));
    if (missing.empty() && waited_for) lobby.log("all robots are here");
    waited_for = std::move(missing);
    return waited_for->empty();
  }

  /// Waits for the robots' answers and for the step's time, but no longer than a nap.
  /// @return whether it is time to step
  bool isTimeToStep(Clock::time_point due) {
    const auto now = Clock::now();
    const auto until = due > now ? std::min(due, now + kNap) : now + kNap;
    std::unique_lock lock(lobby.mutex);
    const auto is_time = [&] { return Clock::now() >= due && (lobby.pace == Pace::realtime || robots.allAnswered()); };
    lobby.bell.wait_until(lock, until, [&] { return run_switch.stop || is_time(); });
    return is_time();
  }

  void nap() {
    std::unique_lock lock(lobby.mutex);
    lobby.bell.wait_for(lock, kNap);
  }

  bool stopAsked() {
    const std::lock_guard lock(lobby.mutex);
    return run_switch.stop;
  }

  bool mayStep() {
    const std::lock_guard lock(lobby.mutex);
    return run_switch.mayStep();
  }

  /// @param due when the step that was taken was due
  /// @return when the next one is
  Clock::time_point noteStep(Clock::time_point due, double period_s) {
    const std::lock_guard lock(lobby.mutex);
    if (run_switch.steps_left > 0) --run_switch.steps_left;
    return run_switch.speed > 0 ? due + seconds(period_s / run_switch.speed) : due;
  }

  bool serve(ServedRun& run, const std::function<bool()>& interrupted) {
    Clock::time_point due;
    while (!run.isOver()) {
      if (interrupted() || stopAsked()) return false;
      admit();
      if (!isEveryoneHere() || !mayStep()) {
        nap();
        due = Clock::now();
        continue;
      }
      const bool is_time = isTimeToStep(due);
      if (!is_time || lobby.pace == Pace::realtime) robots.evictLate();
      if (!is_time) continue;
      robots.handOver(run.environment());
      run.decide();
      geometry.step(run.environment());
      run.stepped();
      robots.tell();
      viewers.tell();
      due = noteStep(due, run.environment().time().period_s);
    }
    return true;
  }
};

EnvironmentServer::EnvironmentServer(const ServerOptions& options, std::shared_ptr<const Exhibit> exhibit)
    : impl_(std::make_unique<Impl>(options, std::move(exhibit))) {}

EnvironmentServer::~EnvironmentServer() = default;

std::vector<int> EnvironmentServer::ports() const { return impl_->ports; }

bool EnvironmentServer::serve(ServedRun& run, const std::function<bool()>& interrupted) {
  const bool is_over = impl_->serve(run, interrupted);
  impl_->sayGoodbye();
  return is_over;
}

}  // namespace robosim
