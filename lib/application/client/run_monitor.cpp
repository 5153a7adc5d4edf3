#include "client/run_monitor.h"

#include <exception>
#include <utility>

#include "net/wire_error.h"
#include "robosim/v1/viewing.grpc.pb.h"
#include "wire/world_wire.h"

namespace robosim {
namespace {

/// Delay before reconnecting to the environment after a failure.
constexpr std::chrono::milliseconds kReconnectPause{500};
constexpr std::chrono::milliseconds kStatusPeriod{250};

RunView::Phase toPhase(v1::RunPhase phase) {
  switch (phase) {
    case v1::RUN_PHASE_WAITING:
      return RunView::Phase::waiting;
    case v1::RUN_PHASE_PAUSED:
      return RunView::Phase::paused;
    case v1::RUN_PHASE_RUNNING:
      return RunView::Phase::running;
    case v1::RUN_PHASE_ENDED:
      return RunView::Phase::ended;
    default:
      return RunView::Phase::unknown;
  }
}

void readRecording(const v1::RunStatus& status, RecordingView& recording) {
  recording.state = status.recording() == v1::RECORDING_STATE_ON    ? RecordingView::State::on
                    : status.recording() == v1::RECORDING_STATE_OFF ? RecordingView::State::off
                                                                    : RecordingView::State::none;
  recording.file = status.recording_file();
  recording.failure = status.recording_failure();
  recording.may_change =
      status.may_operate() && status.phase() != v1::RUN_PHASE_ENDED && recording.state != RecordingView::State::none;
}

/// The world that the environment serves, and whether this client may control its run.
struct ServedSource {
  WorldSource world;
  bool may_operate = false;
};

/// Requests one frame as a viewer: the first contains the world. @throws ConnectionError @throws WireError
ServedSource requestSource(const ConnectOptions& environment, CallCancellation& cancellation) {
  const auto stub = v1::Viewing::NewStub(connect(environment));
  ClientCall call(environment, cancellation);
  const auto stream = stub->Watch(&call.context);
  v1::FrameRequest request;
  request.set_protocol(kProtocolVersion);
  stream->Write(request);
  v1::Frame frame;
  const bool is_received = stream->Read(&frame);
  stream->WritesDone();
  call.context.TryCancel();
  const grpc::Status status = stream->Finish();
  if (!is_received) throw ConnectionError(status, environment);
  return {decode(frame.world().source()), frame.world().may_operate()};
}

}  // namespace

RunMonitor::RunMonitor(ConnectOptions environment, Restart restart)
    : environment_(std::move(environment)),
      restart_(restart),
      watcher_([this] { watch(); }),
      operator_([this] { operate(); }) {}

RunMonitor::~RunMonitor() {
  {
    const std::lock_guard lock(mutex_);
    is_over_ = true;
    for (ControlPanel* panel : {watching_, operating_}) {
      if (panel) panel->leave();
    }
  }
  viewing_.cancel();
  replacing_.cancel();
  condition_.notify_all();
  watcher_.join();
  operator_.join();
}

RunView RunMonitor::newest() {
  const std::lock_guard lock(mutex_);
  RunView view = view_;
  if (received_ && view.phase != RunView::Phase::ended && Clock::now() - *received_ > kSilence) {
    view.phase = RunView::Phase::gone;
    view.absent.clear();
    view.may_restart = view.may_replace = false;
    view.recording.may_change = false;
  }
  return view;
}

void RunMonitor::restart(bool paused) {
  const std::lock_guard lock(mutex_);
  if (!(view_.may_restart || view_.may_replace) || view_.is_restarting) return;
  view_.is_restarting = true;
  view_.restart_problem.clear();
  restart_is_paused_ = paused;
  resume_requested_ = false;
  condition_.notify_all();
}

void RunMonitor::resume() {
  const std::lock_guard lock(mutex_);
  resume_requested_ = true;
  condition_.notify_all();
}

void RunMonitor::setRecording(bool on) {
  const std::lock_guard lock(mutex_);
  RecordingView& recording = view_.recording;
  if (!recording.may_change || recording.is_changing) return;
  recording.is_changing = true;
  recording.problem.clear();
  recording_request_ = on;
  condition_.notify_all();
}

void RunMonitor::watch() {
  for (;;) {
    ControlPanel panel(environment_);
    {
      const std::lock_guard lock(mutex_);
      if (is_over_) return;
      watching_ = &panel;
    }
    std::string problem;
    try {
      panel.watch(kStatusPeriod, [this](const v1::RunStatus& status) { receive(status); });
    } catch (const std::exception& error) {
      problem = error.what();
    }
    std::unique_lock lock(mutex_);
    watching_ = nullptr;
    view_.problem = problem;
    view_.may_restart = view_.may_replace = false;
    view_.recording.may_change = false;
    condition_.wait_for(lock, kReconnectPause, [this] { return is_over_; });
  }
}

void RunMonitor::receive(const v1::RunStatus& status) {
  const bool is_over = status.phase() == v1::RUN_PHASE_ENDED;
  {
    const std::lock_guard lock(mutex_);
    received_ = Clock::now();
    view_.phase = toPhase(status.phase());
    view_.problem.clear();
    view_.may_replace = restart_ == Restart::at_any_time && status.may_operate() && !is_over;
    readRecording(status, view_.recording);
    view_.absent.assign(status.robots_absent().begin(), status.robots_absent().end());
    if (!is_over) {
      view_.may_restart = false;
      source_.reset();
    }
    if (!is_over || source_) return;
  }
  requestSourceOnce();
}

/// Whether the next run may be started is requested once for each run, at its end, because the answer contains the
/// world.
void RunMonitor::requestSourceOnce() {
  bool may_operate = false;
  std::optional<WorldSource> source;
  try {
    auto served = requestSource(environment_, viewing_);
    may_operate = served.may_operate;
    source = std::move(served.world);
  } catch (const std::exception&) {
    return;  // the environment has ended, or its token permits no viewing: asked again with the next status
  }
  const std::lock_guard lock(mutex_);
  source_ = std::move(source);
  view_.may_restart = may_operate;
}

void RunMonitor::operate() {
  for (;;) {
    std::optional<bool> recording;
    bool restarts = false, is_paused = false;
    {
      std::unique_lock lock(mutex_);
      condition_.wait(lock,
                      [this] { return view_.is_restarting || resume_requested_ || recording_request_ || is_over_; });
      if (is_over_) return;
      recording = std::exchange(recording_request_, std::nullopt);
      restarts = view_.is_restarting;
      is_paused = restart_is_paused_;
    }
    if (recording) {
      recordOnce(*recording);
    } else if (restarts) {
      restartOnce(is_paused);
    } else {
      resumeOnce();
    }
  }
}

void RunMonitor::restartOnce(bool paused) {
  std::optional<WorldSource> source;
  {
    const std::lock_guard lock(mutex_);
    source = source_;
  }
  // The answer is received before the restart ends, so that no view offers a second one.
  const std::string problem = attempt([&](ControlPanel& panel) {
    if (!source) source = requestSource(environment_, replacing_).world;  // the run is not over
    receive(panel.load(*source));
    if (!paused) receive(panel.start());
  });
  const std::lock_guard lock(mutex_);
  view_.is_restarting = false;
  view_.restart_problem = problem;
}

void RunMonitor::resumeOnce() {
  const std::string problem = attempt([&](ControlPanel& panel) { receive(panel.start()); });
  const std::lock_guard lock(mutex_);
  resume_requested_ = false;
  view_.restart_problem = problem;
}

void RunMonitor::recordOnce(bool on) {
  v1::RunStatus status;
  const std::string problem = attempt([&](ControlPanel& panel) { status = panel.setRecording(on); });
  const std::lock_guard lock(mutex_);
  // So that no view has the result without its effect.
  if (problem.empty()) readRecording(status, view_.recording);
  view_.recording.is_changing = false;
  view_.recording.problem = problem;
}

template <typename Call>
std::string RunMonitor::attempt(const Call& call) {
  ControlPanel panel(environment_);
  const auto set = [this](ControlPanel* operating) {
    const std::lock_guard lock(mutex_);
    operating_ = operating;
    if (operating && is_over_) operating->leave();
  };
  set(&panel);
  std::string problem;
  try {
    call(panel);
  } catch (const std::exception& error) {
    problem = error.what();
  }
  set(nullptr);
  return problem;
}

}  // namespace robosim
