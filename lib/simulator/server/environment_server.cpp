#include "server/environment_server.h"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <optional>
#include <random>

#include <sched.h>

#include "base/error_list.h"
#include "base/seconds.h"
#include "hardware/inbox_limit.h"
#include "net/completion_queue_server.h"
#include "server/control_panel_session.h"
#include "server/geometry_session.h"
#include "server/robot_session.h"
#include "server/run_status.h"
#include "server/viewer_session.h"

namespace robosim {
namespace {

using Clock = ServingState::Clock;

/// Processors that this process may run on.
std::size_t processorsForUs() {
  cpu_set_t ours;
  return sched_getaffinity(0, sizeof ours, &ours) == 0 ? static_cast<std::size_t>(CPU_COUNT(&ours)) : 1;
}

/// 64 unpredictable bits. They select the results that are checked, and have no effect on the run.
std::uint64_t randomSecret() {
  std::random_device random;
  return std::uint64_t{random()} << 32 | random();
}

}  // namespace

struct EnvironmentServer::Impl {
  /// Measures the step rate over windows of at least one second.
  class StepRate {
   public:
    void note(Clock::time_point now) {
      ++steps_;
      const double passed_s = toSeconds(now - since_);
      if (passed_s < 1) return;
      rate_ = static_cast<double>(steps_) / passed_s;
      steps_ = 0;
      since_ = now;
    }
    /// Restarts the window, so that paused time does not count.
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

  ServingState serving;
  RunOperations operations;
  RunControl& run_control = operations.run_control;
  RobotSession robots{serving};
  ViewerSession viewers{serving};
  GeometrySession geometry;
  ControlPanelSession panels{serving};
  OnLostRobot on_lost_robot;
  bool awaits_next_run;
  bool has_run_ended = false;  ///< the run is over, and the next one is awaited
  std::optional<std::vector<std::string>>
      waited_for;         ///< robots not yet connected at the last check; nullopt: not checked
  Clock::time_point due;  ///< time of the next step
  StepRate rate;
  std::uint64_t messages_dropped = 0;  ///< already logged
  std::vector<std::uint8_t> pictured;  ///< by robot: whether a client receives its pictures
  CompletionQueueServer queue_server;

  Impl(const ServerOptions& options, std::shared_ptr<const RunInfo> run_info)
      : geometry(serving, ResultSamples(options.check_results, randomSecret())),
        on_lost_robot(options.on_lost_robot),
        awaits_next_run(options.awaits_next_run),
        queue_server({{options.listen.viewers, &viewers},
                      {options.listen.robots, &robots},
                      {options.listen.geometry, &geometry},
                      {options.listen.control, &panels}},
                     {.tls = options.tls,
                      .option = "--listen",
                      .keepalive = options.keepalive,
                      .standard_services = options.standard_services,
                      .access = options.access}) {
    serving.log = options.log;
    serving.step_deadline = options.step_deadline;
    serving.hello_deadline = options.hello_deadline;
    serving.load_deadline = options.load_deadline;
    serving.now = options.now;
    serving.pace = options.pace;
    serving.access = options.access;
    serving.queue_server = &queue_server;
    run_control.is_paused = options.is_paused;
    run_control.speed = options.pace == Pace::realtime && options.speed == 0 ? 1 : options.speed;
    due = serving.now();
    resetSessions(std::move(run_info));
    viewers.open(queue_server.queuesFor(0));
    robots.open(queue_server.queuesFor(1));
    geometry.open(queue_server.queuesFor(2));
    panels.open(queue_server.queuesFor(3));
  }

  ~Impl() {
    close();
    panels.finishPreparing();
  }

  void resetSessions(std::shared_ptr<const RunInfo> run_info) {
    serving.run_info = std::move(run_info);
    waited_for.reset();
    robots.reset();
    viewers.reset();
    geometry.reset();
  }

  /// Serves the robots that have been added since the last call.
  void addRobots(ServedRun& run) {
    if (run.environment().robotCount() == serving.run_info->robot_names.size()) return;
    run.addRobots();
    robots.addRobots();
    viewers.addRobots();
  }

  /// Requests the pictures that clients receive, including those that have connected since the last call.
  void requestPictures(ServedRun& run) {
    pictured.assign(serving.run_info->robot_names.size(), 0);
    robots.addPictured(pictured);
    viewers.addPictured(pictured);
    run.requestPictures(pictured);
  }

  /// Admits the clients that have connected since the last call.
  void admit(ServedRun& run) {
    requestPictures(run);
    robots.admit();
    geometry.admit();
    viewers.publish();
  }

  RunReport report() const {
    RunReport report;
    report.on_lost_robot = on_lost_robot;
    robots.describe(report);
    geometry.describe(report);
    return report;
  }

  /// Replaces the run that is served. The old RunInfo stays alive until the sessions have switched to the new one.
  void replace(ServedRun& run, std::unique_ptr<PreparedRun> next) {
    const auto previous_run_info = run.runInfo();
    if (!std::exchange(has_run_ended, false)) run.ends(report());
    run.replace(std::move(next));
    resetSessions(run.runInfo());
    areRobotsConnected();
  }

  void describe(const ServedRun& run, v1::RunStatus& status) const {
    const bool waits = !waited_for || !waited_for->empty();
    const bool is_running = !waits && run_control.mayStep();
    status.Clear();
    status.set_phase(serving.is_over || run.isOver() ? v1::RUN_PHASE_ENDED
                     : waits                         ? v1::RUN_PHASE_WAITING
                     : is_running                    ? v1::RUN_PHASE_RUNNING
                                                     : v1::RUN_PHASE_PAUSED);
    status.set_speed(run_control.speed);
    status.set_steps_per_s(is_running ? rate.stepsPerSecond() : 0);
    status.set_robots_connected(static_cast<std::uint32_t>(robots.connected()));
    describeAbsent(robots.absent(), status);
    status.set_viewers(static_cast<std::uint32_t>(viewers.count()));
    status.set_geometry_workers(static_cast<std::uint32_t>(geometry.count()));
    status.set_late_commands(robots.late());
    describeRun(run, status);
    describeReport(report(), status);
  }

  /// Ends all calls, and waits until their final status has been sent.
  void close() {
    if (std::exchange(serving.is_over, true)) return;
    panels.publishLast(operations);
    serving.endSessions();
    queue_server.close();
  }

  /// Whether all robots that a step requires are connected; logs the missing ones whenever they change.
  bool areRobotsConnected() {
    auto missing = robots.awaited(on_lost_robot);
    if (waited_for && missing == *waited_for) return missing.empty();
    if (!missing.empty()) {
      serving.log("waiting for " + listed(missing));
    } else if (waited_for) {
      serving.log("all robots are connected");
    }
    waited_for = std::move(missing);
    return waited_for->empty();
  }

  /// Whether something is pending that is executed between steps.
  bool mustAct() const { return serving.wake_requested || panels.isPrepared(); }

  /// Waits for the robots' answers and for the step's time, for at most ServingState::kPollInterval.
  /// @return whether it is time to step
  bool isTimeToStep() {
    const auto is_time = [&] {
      return serving.now() >= due && (serving.pace == Pace::realtime || robots.allAnswered());
    };
    // Busy polling would take a processor from the robots' processes when they use all of them.
    static const std::size_t processors = processorsForUs();
    queue_server.setAdaptivePolling(robots.processes() < processors);
    const auto until_due = due - serving.now();
    serving.pollUntil(until_due > Clock::duration::zero() ? until_due : ServingState::kPollInterval,
                      [&] { return mustAct() || is_time(); });
    return is_time();
  }

  /// Executes the requests of control panels, and of clients that the run itself serves.
  void executeRequests(ServedRun& run) {
    const double speed = run_control.speed;
    panels.execute(operations);
    run.poll(run_control);
    addRobots(run);  // of clients that the run itself serves
    if (auto next = run.takeRequestedRun()) replace(run, std::move(next));
    if (run_control.speed != speed) due = serving.now();
  }

  void logDroppedMessages(const State& state) {
    const auto before = std::exchange(messages_dropped, state.messages_dropped);
    if (state.messages_dropped <= before) return;
    serving.limited_log.write("messages dropped", std::to_string(state.messages_dropped - before) +
                                                      " messages dropped in step " + std::to_string(state.time.step) +
                                                      ": a robot sends at most " + std::to_string(kMaxMessagesSent) +
                                                      " messages in a step, and receives at most " +
                                                      std::to_string(InboxLimit::kMaxMessages) + " and " +
                                                      std::to_string(InboxLimit::kMaxBytes / 1024) + " KiB");
  }

  void noteStep(double period_s) {
    if (run_control.steps_left > 0) --run_control.steps_left;
    if (run_control.speed > 0) due += fromSeconds(period_s / run_control.speed);
    rate.note(serving.now());
  }

  /// Reports the end of a run after which the server awaits the next one.
  void endOnce(ServedRun& run) {
    if (std::exchange(has_run_ended, true)) return;
    run.ends(report());
    serving.log(awaits_next_run ? "the run is over; waiting for a control panel to load the next world, or to stop"
                                : "the run is over");
  }

  Served serve(ServedRun& run, const std::function<bool()>& interrupted) {
    operations.prepare = [&run](const WorldSource& source) { return run.prepare(source); };
    operations.make_ready = [&run](PreparedRun& next) { run.makeReady(next); };
    operations.replace = [&](std::unique_ptr<PreparedRun> next) { replace(run, std::move(next)); };
    serving.interrupted = interrupted;
    operations.set_recording = [&run](bool on) { run.setRecording(on); };
    operations.intervene = [&](const Intervention& change) {
      if (has_run_ended || run.isOver())
        return std::string("the run is over, and its result stands; load the next one");
      std::string fault = run.environment().apply(change);
      addRobots(run);
      return fault;
    };
    operations.describe = [&](v1::RunStatus& status) { describe(run, status); };
    admit(run);
    areRobotsConnected();  // so that a status requested first is correct
    while (awaits_next_run || !run.isOver()) {
      serving.wake_requested = false;
      serving.checkSessions();
      executeRequests(run);
      addRobots(run);  // of programs that the run serves
      if (run_control.stop) return Served::stopped;
      if (interrupted()) return Served::interrupted;
      admit(run);
      if (run.isOver()) {
        endOnce(run);
        serving.pollUntil(ServingState::kPollInterval, [&] { return mustAct(); });
        continue;
      }
      if (on_lost_robot == OnLostRobot::fail && robots.isAnyLost()) {
        serving.log("the run ends because of --on-lost-robot fail: lost " + listed(robots.lost()));
        return Served::robot_lost;
      }
      if (!areRobotsConnected() || !run_control.mayStep()) {
        serving.pollUntil(ServingState::kPollInterval, [&] { return mustAct(); });
        due = serving.now();
        rate.rest(due);
        continue;
      }
      const bool is_time = isTimeToStep();
      if (!is_time || serving.pace == Pace::realtime) robots.disconnectLate();
      if (!is_time) continue;
      if (on_lost_robot != OnLostRobot::continue_ && robots.isAnyLost()) continue;  // lost during the wait
      const std::size_t late = robots.applyAnswers(run.environment());
      requestPictures(run);
      run.decide();
      geometry.step(run.environment());
      addRobots(run);  // of the world file
      logDroppedMessages(run.environment().state());
      run.stepped(late);
      addRobots(run);  // of observers
      robots.publish();
      viewers.publish();
      noteStep(run.environment().time().period_s);
    }
    return Served::to_its_end;
  }
};

EnvironmentServer::EnvironmentServer(const ServerOptions& options, std::shared_ptr<const RunInfo> run_info)
    : impl_(std::make_unique<Impl>(options, std::move(run_info))) {}

EnvironmentServer::~EnvironmentServer() = default;

std::array<int, 4> EnvironmentServer::ports() const {
  const CompletionQueueServer& at = impl_->queue_server;
  return {at.port(0), at.port(1), at.port(2), at.port(3)};
}

Served EnvironmentServer::serve(ServedRun& run, const std::function<bool()>& interrupted) {
  const Served how = impl_->serve(run, interrupted);
  const RunReport report = impl_->report();
  impl_->close();
  if (!impl_->has_run_ended) run.ends(report);
  return how;
}

}  // namespace robosim
