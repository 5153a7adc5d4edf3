#include "server/environment_server.h"

#include <algorithm>
#include <optional>

#include <sched.h>

#include "base/error_list.h"
#include "net/switchboard.h"
#include "server/control_panel_conversation.h"
#include "server/geometry_conversation.h"
#include "server/robot_conversation.h"
#include "server/viewer_conversation.h"

namespace robosim {
namespace {

using Clock = Lobby::Clock;

Clock::duration seconds(double s) {
  return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(s));
}

/// Processors that this process may run on.
std::size_t processorsForUs() {
  cpu_set_t ours;
  return sched_getaffinity(0, sizeof ours, &ours) == 0 ? static_cast<std::size_t>(CPU_COUNT(&ours)) : 1;
}

/// How many steps a second the run takes of late.
class StepRate {
 public:
  void note(Clock::time_point now) {
    ++steps_;
    const std::chrono::duration<double> passed = now - since_;
    if (passed.count() < 1) return;
    rate_ = static_cast<double>(steps_) / passed.count();
    steps_ = 0;
    since_ = now;
  }
  /// Nobody steps at the moment, and that time does not count.
  void rest(Clock::time_point now) {
    steps_ = 0;
    since_ = now;
  }
  double stepsPerSecond() const { return rate_; }

 private:
  Clock::time_point since_ = Clock::now();
  std::uint64_t steps_ = 0;
  double rate_ = 0;
};

}  // namespace

struct EnvironmentServer::Impl {
  Lobby lobby;
  PanelDesk desk;
  RunSwitch& run_switch = desk.run_switch;
  RobotConversation robots{lobby};
  ViewerConversation viewers{lobby};
  GeometryConversation geometry{lobby};
  ControlPanelConversation panels{lobby};
  std::optional<std::vector<std::string>> waited_for;  ///< robots that had not come yet; nullopt: not asked yet
  Clock::time_point due;                               ///< when the next step is
  StepRate rate;
  Switchboard switchboard;

  Impl(const ServerOptions& options, std::shared_ptr<const Exhibit> exhibit)
      : switchboard({{options.listen.viewers, &viewers},
                     {options.listen.robots, &robots},
                     {options.listen.geometry, &geometry},
                     {options.listen.control, &panels}},
                    {options.tls, "--listen", options.keepalive}) {
    lobby.log = options.log;
    lobby.step_deadline = options.step_deadline;
    lobby.hello_deadline = options.hello_deadline;
    lobby.now = options.now;
    lobby.pace = options.pace;
    lobby.access = options.access;
    lobby.switchboard = &switchboard;
    run_switch.is_paused = options.is_paused;
    run_switch.speed = options.pace == Pace::realtime && options.speed == 0 ? 1 : options.speed;
    due = lobby.now();
    show(std::move(exhibit));
    viewers.open(switchboard.line(0));
    robots.open(switchboard.line(1));
    geometry.open(switchboard.line(2));
    panels.open(switchboard.line(3));
  }

  ~Impl() { close(); }

  void show(std::shared_ptr<const Exhibit> exhibit) {
    lobby.exhibit = std::move(exhibit);
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

  /// Another world in place of the one that is run. What clients are shown stays until they are shown the other.
  void load(ServedRun& run, const WorldSource& source) {
    const auto shown_until_now = run.exhibit();
    run.load(source);
    show(run.exhibit());
    isEveryoneHere();
  }

  void describe(const ServedRun& run, wire::RunStatus& status) const {
    const Exhibit& exhibit = *run.exhibit();
    const State& state = exhibit.environment.state();
    const bool waits = !waited_for || !waited_for->empty();
    const bool goes_on = !waits && run_switch.mayStep();
    status.Clear();
    status.set_phase(lobby.is_over ? wire::ENDED : waits ? wire::WAITING : goes_on ? wire::RUNNING : wire::PAUSED);
    status.set_world(exhibit.environment.world().name);
    status.set_world_version(exhibit.world_version);
    status.set_step(state.time.step);
    status.set_time_s(state.time.seconds());
    status.set_speed(run_switch.speed);
    status.set_steps_per_s(goes_on ? rate.stepsPerSecond() : 0);
    status.set_robots(static_cast<std::uint32_t>(exhibit.robot_names.size()));
    status.set_robots_connected(static_cast<std::uint32_t>(robots.connected()));
    constexpr std::size_t most_named = 100;
    std::vector<std::string> absent = robots.absent();
    absent.resize(std::min(absent.size(), most_named));
    status.mutable_robots_absent()->Assign(absent.begin(), absent.end());
    status.set_robots_active(
        static_cast<std::uint32_t>(std::count(state.activity.begin(), state.activity.end(), Activity::active)));
    status.set_viewers(static_cast<std::uint32_t>(viewers.count()));
    status.set_geometry_workers(static_cast<std::uint32_t>(geometry.count()));
    status.set_late(robots.late());
    if (state.winner) status.set_winner(exhibit.robot_names[*state.winner]);
  }

  /// Says goodbye to everyone, and waits until they have heard it.
  void close() {
    if (std::exchange(lobby.is_over, true)) return;
    panels.sayGoodbye(desk);
    robots.sayGoodbye();
    viewers.sayGoodbye();
    geometry.sayGoodbye();
    switchboard.close();
  }

  /// Whether all networked robots have been here; says who is missing, each time that changes.
  bool isEveryoneHere() {
    if (waited_for && waited_for->empty()) return true;
    auto missing = robots.notYetHere();
    if (missing == waited_for) return false;
    if (!missing.empty()) lobby.log("waiting for " + listed(missing));
    if (missing.empty() && waited_for) lobby.log("all robots are here");
    waited_for = std::move(missing);
    return waited_for->empty();
  }

  /// Waits for the robots' answers and for the step's time, but no longer than a nap.
  /// @return whether it is time to step
  bool isTimeToStep() {
    const auto is_time = [&] { return lobby.now() >= due && (lobby.pace == Pace::realtime || robots.allAnswered()); };
    // Where the robots' processes want all processors, one that looks out for their answers is in their way.
    static const std::size_t processors = processorsForUs();
    switchboard.lookOut(robots.processes() < processors);
    const auto until_due = due - lobby.now();
    lobby.nap(until_due > Clock::duration::zero() ? until_due : Lobby::kNap, [&] { return lobby.rang || is_time(); });
    return is_time();
  }

  /// Does what the control panels ask.
  void obeyPanels() {
    const double speed = run_switch.speed;
    panels.obey(desk);
    if (run_switch.speed != speed) due = lobby.now();
  }

  void noteStep(double period_s) {
    if (run_switch.steps_left > 0) --run_switch.steps_left;
    if (run_switch.speed > 0) due += seconds(period_s / run_switch.speed);
    rate.note(lobby.now());
  }

  Served serve(ServedRun& run, const std::function<bool()>& interrupted) {
    desk.load = [&](const WorldSource& source) { load(run, source); };
    lobby.interrupted = interrupted;
    desk.describe = [&](wire::RunStatus& status) { describe(run, status); };
    admit();
    isEveryoneHere();  // a panel that asks first of all is to be told how the run stands
    while (!run.isOver()) {
      lobby.rang = false;
      obeyPanels();
      if (run_switch.stop) return Served::stopped;
      if (interrupted()) return Served::interrupted;
      admit();
      if (!isEveryoneHere() || !run_switch.mayStep()) {
        lobby.nap(Lobby::kNap, [&] { return lobby.rang; });
        due = lobby.now();
        rate.rest(due);
        continue;
      }
      const bool is_time = isTimeToStep();
      if (!is_time || lobby.pace == Pace::realtime) robots.evictLate();
      if (!is_time) continue;
      const std::size_t late = robots.handOver(run.environment());
      run.decide();
      geometry.step(run.environment());
      run.stepped(late);
      robots.tell();
      viewers.tell();
      noteStep(run.environment().time().period_s);
    }
    return Served::to_its_end;
  }
};

EnvironmentServer::EnvironmentServer(const ServerOptions& options, std::shared_ptr<const Exhibit> exhibit)
    : impl_(std::make_unique<Impl>(options, std::move(exhibit))) {}

EnvironmentServer::~EnvironmentServer() = default;

std::array<int, 4> EnvironmentServer::ports() const {
  const Switchboard& at = impl_->switchboard;
  return {at.port(0), at.port(1), at.port(2), at.port(3)};
}

Served EnvironmentServer::serve(ServedRun& run, const std::function<bool()>& interrupted) {
  const Served how = impl_->serve(run, interrupted);
  impl_->close();
  return how;
}

}  // namespace robosim
