#pragma once
#include <cstdint>
#include <functional>
#include <future>
#include <memory>
#include <vector>

#include "net/completion_queue_server.h"
#include "robosim/v1/control_panel.grpc.pb.h"
#include "robots/world_source.h"
#include "server/run_control.h"
#include "server/served_run.h"
#include "server/serving_state.h"
#include "world/intervention.h"

namespace robosim {

/// Generated service that serves Watch as a bidirectional stream, which it is on the wire. gRPC delivers a
/// server-streaming call only with its request, so that a call without one would have no deadline.
class WatchAsStream : public v1::ControlPanel::Service {
 public:
  WatchAsStream();
};

/// Generated service with the method styles that ControlPanelSession uses.
using ControlPanelService = v1::ControlPanel::WithRawMethod_Load<v1::ControlPanel::WithAsyncMethod_SetRecording<
    v1::ControlPanel::WithAsyncMethod_Supervise<v1::ControlPanel::WithAsyncMethod_Start<
        v1::ControlPanel::WithAsyncMethod_Pause<v1::ControlPanel::WithAsyncMethod_Step<
            v1::ControlPanel::WithAsyncMethod_SetSpeed<v1::ControlPanel::WithAsyncMethod_Stop<
                v1::ControlPanel::WithAsyncMethod_GetStatus<WatchAsStream>>>>>>>>>;

/// Operations on the run that control panels can request.
struct RunOperations {
  RunControl run_control;
  /// Builds the run of another world; called on another thread. @throws ConfigError when the world is invalid.
  std::function<std::unique_ptr<PreparedRun>(const WorldSource&)> prepare;
  /// Completes a prepared run, as far as that may fail; after an exception the present run continues.
  std::function<void(PreparedRun&)> make_ready;
  /// Replaces the run that is served by one that is ready.
  std::function<void(std::unique_ptr<PreparedRun>)> replace;
  /// Starts or stops the recording. @throws ConfigError when it cannot be started or completed
  std::function<void(bool)> set_recording;
  /// Environment::apply() of the run. @return what is wrong; empty when it is applied
  std::function<std::string(const Intervention&)> intervene;
  /// Fills in the status of the run.
  std::function<void(v1::RunStatus&)> describe = [](v1::RunStatus&) {};
};

/// Server side of the ControlPanel service. Calls are queued until execute(), which runs between two steps: nothing
/// changes within a step, and a status is consistent.
class ControlPanelSession final : public ControlPanelService {
 public:
  explicit ControlPanelSession(ServingState& serving);
  ~ControlPanelSession() override;

  /// Starts to accept calls.
  void open(const CompletionQueueServer::ServiceQueues& queues);
  /// Executes the queued calls, answers those whose steps are complete, and sends statuses to watchers. Call it between
  /// steps.
  void execute(RunOperations& operations);
  /// Sends the last status to watchers, before the run's end ends all calls.
  void publishLast(RunOperations& operations);
  /// Whether a world has been built, and awaits execute(). The thread that builds it ends the wait of
  /// ServingState::queue_server.
  bool isPrepared() const;
  /// Waits for that thread. Call it before ServingState::queue_server is destroyed.
  void finishPreparing() { building_ = {}; }

 private:
  class Call;
  template <typename Request>
  struct Kind;
  template <typename Request>
  class PlainCall;
  class LoadCall;
  class Watcher;
  template <typename Request>
  void serve(const CompletionQueueServer::ServiceQueues& queues, const Kind<Request>& kind);
  void queue(const std::shared_ptr<Call>& call);
  void execute(RunOperations& operations, Call& call);
  void describe(const RunOperations& operations, const ServerSession& session, v1::RunStatus& status) const;
  void refuse(Call& call, const grpc::Status& status);
  bool isLoading() const;
  void advanceLoad(RunOperations& operations);
  void beginPreparing(RunOperations& operations);
  void answerSteppers(RunOperations& operations);

  ServingState& serving_;
  std::vector<std::shared_ptr<Call>> calls_;  ///< not yet executed
  std::vector<std::shared_ptr<Watcher>> watchers_;
  std::vector<std::shared_ptr<Call>> steppers_;         ///< executed; answered after their last step
  std::shared_ptr<LoadCall> load_;                      ///< the call that sends a world, or whose world is being built
  std::future<std::unique_ptr<PreparedRun>> prepared_;  ///< the run being built for load_
  std::future<void> building_;                          ///< the thread that builds it; the destructor joins it
};

}  // namespace robosim
