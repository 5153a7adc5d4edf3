#include "client/run_monitor.h"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>

#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>

#include "net/error_status.h"
#include "remote/testing/test_robot.h"
#include "robosim/v1/control_panel.grpc.pb.h"
#include "robosim/v1/viewing.grpc.pb.h"
#include "wire/world_wire.h"

namespace robosim {
namespace {

/// An environment whose statuses and answers the test determines.
class ScriptedEnvironment {
 public:
  ScriptedEnvironment() {
    grpc::ServerBuilder builder;
    builder.AddListeningPort("127.0.0.1:0", grpc::InsecureServerCredentials(), &port_);
    builder.RegisterService(&panel_);
    builder.RegisterService(&viewing_);
    server_ = builder.BuildAndStart();
    status_.set_phase(v1::RUN_PHASE_RUNNING);
    status_.set_recording(v1::RECORDING_STATE_OFF);
    status_.set_may_operate(true);
  }
  ~ScriptedEnvironment() {
    {
      const std::lock_guard lock(mutex_);
      is_over_ = true;
    }
    changed_.notify_all();
    server_->Shutdown(std::chrono::system_clock::now());
    server_->Wait();
  }
  ScriptedEnvironment(const ScriptedEnvironment&) = delete;
  ScriptedEnvironment& operator=(const ScriptedEnvironment&) = delete;

  ConnectOptions connectOptions() const { return {.address = "127.0.0.1:" + std::to_string(port_)}; }
  /// Changes the status, which is sent at once.
  void send(const std::function<void(v1::RunStatus&)>& change) {
    {
      const std::lock_guard lock(mutex_);
      change(status_);
      ++version_;
    }
    changed_.notify_all();
  }
  /// Whether watchers are accepted; otherwise their calls end.
  void accept(bool accepts) {
    {
      const std::lock_guard lock(mutex_);
      accepts_watchers_ = accepts;
    }
    changed_.notify_all();
  }

  std::atomic<int> starts = 0, records = 0;
  std::atomic<bool> answers_requests = true;  ///< to start and stop the recording
  std::atomic<bool> is_silent = false;        ///< whether a status is sent only after a change
  grpc::Status refusal = grpc::Status::OK;    ///< answer to these requests
  std::string loaded;                         ///< text of the world

 private:
  struct Panel final : v1::ControlPanel::Service {
    explicit Panel(ScriptedEnvironment& e) : environment(e) {}
    grpc::Status Watch(grpc::ServerContext*, const v1::WatchRequest* request,
                       grpc::ServerWriter<v1::RunStatus>* out) override {
      return environment.watch(*request, *out);
    }
    grpc::Status SetRecording(grpc::ServerContext*, const v1::SetRecordingRequest* request,
                              v1::RunStatus* reply) override {
      return environment.setRecording(request->on(), *reply);
    }
    grpc::Status Load(grpc::ServerContext*, grpc::ServerReader<v1::LoadRequest>* in, v1::RunStatus*) override {
      std::string bytes;
      for (v1::LoadRequest piece; in->Read(&piece);) bytes += piece.piece();
      v1::WorldSource world;
      if (!world.ParseFromString(bytes)) return {grpc::StatusCode::INVALID_ARGUMENT, "no world"};
      environment.loaded = decode(world).text;
      return grpc::Status::OK;
    }
    grpc::Status Start(grpc::ServerContext*, const v1::StartRequest*, v1::RunStatus* reply) override {
      environment.send([&](v1::RunStatus& status) {
        status.set_phase(v1::RUN_PHASE_RUNNING);
        *reply = status;
      });
      ++environment.starts;
      return grpc::Status::OK;
    }
    ScriptedEnvironment& environment;
  };
  struct Viewing final : v1::Viewing::Service {
    grpc::Status Watch(grpc::ServerContext*, grpc::ServerReaderWriter<v1::Frame, v1::FrameRequest>* stream) override {
      v1::FrameRequest request;
      if (!stream->Read(&request)) return grpc::Status::OK;
      v1::Frame frame;
      WorldSource world;
      world.file = "w.xml";
      world.text = "<world/>";
      encode(world, *frame.mutable_world()->mutable_source());
      frame.mutable_world()->set_may_operate(true);
      stream->Write(frame);
      return grpc::Status::OK;
    }
  };

  grpc::Status watch(const v1::WatchRequest& request, grpc::ServerWriter<v1::RunStatus>& out) {
    const std::chrono::duration<double> period(request.min_interval_s());
    std::unique_lock lock(mutex_);
    while (!is_over_ && accepts_watchers_) {
      const v1::RunStatus status = status_;
      const int version = version_;
      lock.unlock();
      if (!out.Write(status)) return grpc::Status::OK;
      lock.lock();
      const auto has_changed = [&] { return is_over_ || !accepts_watchers_ || version != version_; };
      // As an environment does, at least every period; an ended one needs no sign of life.
      if (is_silent || status.phase() == v1::RUN_PHASE_ENDED) {
        changed_.wait(lock, has_changed);
      } else {
        changed_.wait_for(lock, period, has_changed);
      }
    }
    return {grpc::StatusCode::UNAVAILABLE, "the environment ends"};
  }
  grpc::Status setRecording(bool on, v1::RunStatus& reply) {
    ++records;
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return is_over_ || answers_requests; });
    if (!refusal.ok()) return refusal;
    status_.set_recording(on ? v1::RECORDING_STATE_ON : v1::RECORDING_STATE_OFF);
    status_.set_recording_file("run.rawlog");
    reply = status_;
    return grpc::Status::OK;
  }

  Panel panel_{*this};
  Viewing viewing_;
  std::mutex mutex_;  ///< guards the members that follow
  std::condition_variable changed_;
  v1::RunStatus status_;
  int version_ = 0;
  bool is_over_ = false, accepts_watchers_ = true;
  int port_ = 0;
  std::unique_ptr<grpc::Server> server_;
};

struct RunMonitorTest : testing::Test {
  /// Waits for a view: it.
  RunView until(const std::function<bool(const RunView&)>& holds, const CallSite& place = CallSite::here()) {
    RunView view;
    const auto is_so = [&] {
      view = monitor.newest();
      return holds(view);
    };
    waitUntil(
        is_so, [] {}, place);
    return view;
  }
  RunView untilPhase(RunView::Phase phase, const CallSite& place = CallSite::here()) {
    return until([&](const RunView& view) { return view.phase == phase; }, place);
  }

  ScriptedEnvironment environment;
  RunMonitor monitor{environment.connectOptions()};
};

TEST_F(RunMonitorTest, ReportsPhaseAbsentRobotsAndRecording) {
  environment.send([](v1::RunStatus& status) {
    status.set_phase(v1::RUN_PHASE_WAITING);
    status.add_robots_absent("Ann");
    status.set_recording(v1::RECORDING_STATE_ON);
    status.set_recording_file("run.rawlog");
  });
  const RunView view = untilPhase(RunView::Phase::waiting);
  EXPECT_EQ(view.absent, std::vector<std::string>{"Ann"});
  EXPECT_EQ(view.recording,
            (RecordingView{.state = RecordingView::State::on, .file = "run.rawlog", .may_change = true}));
  EXPECT_FALSE(view.may_restart);
}

TEST_F(RunMonitorTest, ReportsThatTheEnvironmentIsGoneWhenItsStatusesEnd) {
  untilPhase(RunView::Phase::running);
  environment.is_silent = true;
  const RunView view = untilPhase(RunView::Phase::gone);
  EXPECT_FALSE(view.recording.may_change);
  environment.is_silent = false;
  environment.send([](v1::RunStatus&) {});
  untilPhase(RunView::Phase::running);
}

TEST_F(RunMonitorTest, ReconnectsAfterALostConnection) {
  untilPhase(RunView::Phase::running);
  environment.accept(false);
  const RunView view = until([](const RunView& now) { return !now.problem.empty(); });
  EXPECT_NE(view.problem.find("the environment ends"), std::string::npos) << view.problem;
  EXPECT_FALSE(view.recording.may_change);
  environment.accept(true);
  until([](const RunView& now) { return now.problem.empty() && now.recording.may_change; });
}

TEST_F(RunMonitorTest, StartsAndStopsTheRecording) {
  untilPhase(RunView::Phase::running);
  monitor.setRecording(true);
  const auto is = [](RecordingView::State state) {
    return [state](const RunView& view) { return view.recording.state == state && !view.recording.is_changing; };
  };
  const RunView view = until(is(RecordingView::State::on));
  EXPECT_EQ(view.recording.file, "run.rawlog");
  EXPECT_EQ(view.recording.problem, "");
  until([](const RunView& now) { return now.recording.may_change; });
  monitor.setRecording(false);
  until(is(RecordingView::State::off));
  EXPECT_EQ(environment.records, 2);
}

TEST_F(RunMonitorTest, ReportsWhyTheRecordingCannotBeChangedUntilTheNextRequest) {
  environment.refusal = errorStatus(v1::ERROR_REASON_RECORDING_UNAVAILABLE, "the disk is full");
  untilPhase(RunView::Phase::running);
  monitor.setRecording(true);
  RunView view = until([](const RunView& now) { return !now.recording.problem.empty(); });
  EXPECT_NE(view.recording.problem.find("the disk is full"), std::string::npos) << view.recording.problem;
  EXPECT_EQ(view.recording.state, RecordingView::State::off);
  EXPECT_FALSE(view.recording.is_changing);
  environment.refusal = grpc::Status::OK;
  until([](const RunView& now) { return now.recording.may_change; });
  monitor.setRecording(true);
  EXPECT_EQ(monitor.newest().recording.problem, "");
  until([](const RunView& now) { return now.recording.state == RecordingView::State::on; });
}

TEST_F(RunMonitorTest, RequestsNoRecordingThatItMayNotChange) {
  environment.send([](v1::RunStatus& status) { status.set_may_operate(false); });
  until([](const RunView& view) { return view.phase == RunView::Phase::running && !view.recording.may_change; });
  monitor.setRecording(true);
  EXPECT_FALSE(monitor.newest().recording.is_changing);
  for (const auto state : {v1::RECORDING_STATE_NONE, v1::RECORDING_STATE_OFF}) {
    environment.send([&](v1::RunStatus& status) {
      status.set_may_operate(true);
      status.set_recording(state);
      status.set_phase(state == v1::RECORDING_STATE_NONE ? v1::RUN_PHASE_PAUSED : v1::RUN_PHASE_ENDED);
    });
    untilPhase(state == v1::RECORDING_STATE_NONE ? RunView::Phase::paused : RunView::Phase::ended);
    monitor.setRecording(true);
    EXPECT_FALSE(monitor.newest().recording.is_changing);
  }
  EXPECT_EQ(environment.records, 0);
}

TEST_F(RunMonitorTest, StartsTheNextRunWithTheWorldThatItReceivesAsAViewer) {
  untilPhase(RunView::Phase::running);
  monitor.restart(false);
  EXPECT_FALSE(monitor.newest().is_restarting) << "the run is not over";
  environment.send([](v1::RunStatus& status) { status.set_phase(v1::RUN_PHASE_ENDED); });
  until([](const RunView& view) { return view.may_restart; });
  monitor.restart(false);
  const RunView view = until([](const RunView& now) { return !now.is_restarting; });
  EXPECT_EQ(view.phase, RunView::Phase::running);
  EXPECT_FALSE(view.may_restart);
  EXPECT_EQ(view.restart_problem, "");
  EXPECT_EQ(environment.starts, 1);
  EXPECT_EQ(environment.loaded, "<world/>");
}

TEST_F(RunMonitorTest, EndsWhileARequestIsNotAnswered) {
  environment.answers_requests = false;
  untilPhase(RunView::Phase::running);
  monitor.setRecording(true);
  waitUntil([&] { return environment.records == 1; }, [] {});
  EXPECT_TRUE(monitor.newest().recording.is_changing);
}

TEST(RunMonitor, ReportsWhyThereIsNoStatus) {
  ConnectOptions nowhere;
  {
    const ScriptedEnvironment gone;
    nowhere = gone.connectOptions();
  }
  RunMonitor monitor(nowhere);
  RunView view;
  waitUntil([&] { return !(view = monitor.newest()).problem.empty(); }, [] {});
  EXPECT_EQ(view.phase, RunView::Phase::unknown);
  EXPECT_NE(view.problem.find(nowhere.address), std::string::npos) << view.problem;
}

}  // namespace
}  // namespace robosim
