#pragma once
#include <functional>
#include <memory>
#include <vector>

#include "net/control_panel.grpc.pb.h"
#include "net/server_stream.h"
#include "robots/world_source.h"
#include "server/lobby.h"
#include "server/run_switch.h"

namespace robosim {

/// gRPC's base for it: all calls without threads of our own.
using ControlPanelService = wire::ControlPanel::WithRawCallbackMethod_Watch<
    wire::ControlPanel::WithCallbackMethod_Load<wire::ControlPanel::WithCallbackMethod_Start<
        wire::ControlPanel::WithCallbackMethod_Pause<wire::ControlPanel::WithCallbackMethod_Step<
            wire::ControlPanel::WithCallbackMethod_SetSpeed<wire::ControlPanel::WithCallbackMethod_Stop<
                wire::ControlPanel::WithCallbackMethod_Status<wire::ControlPanel::Service>>>>>>>>;

/// What a control panel may touch. All of it belongs to the thread that steps the environment.
struct PanelDesk {
  RunSwitch run_switch;
  /// Puts another world in place of the one that is run. @throws ConfigError when it is no good; the run then goes on.
  std::function<void(const WorldSource&)> load;
  /// Fills in how the run stands.
  std::function<void(wire::RunStatus&)> describe;
};

/// The conversation with control panels. Calls come in on gRPC's threads, and wait until the thread that steps the
/// environment does what they ask, between two steps: so nothing changes within a step, and a status is of one moment.
class ControlPanelConversation final : public ControlPanelService {
 public:
  explicit ControlPanelConversation(Lobby& lobby);
  ~ControlPanelConversation() override;

  /// @name gRPC calls these when a panel calls
  ///@{
  grpc::ServerReadReactor<wire::WorldPiece>* Load(grpc::CallbackServerContext*, wire::RunStatus*) override;
  grpc::ServerUnaryReactor* Start(grpc::CallbackServerContext*, const wire::PanelRequest*, wire::RunStatus*) override;
  grpc::ServerUnaryReactor* Pause(grpc::CallbackServerContext*, const wire::PanelRequest*, wire::RunStatus*) override;
  grpc::ServerUnaryReactor* Step(grpc::CallbackServerContext*, const wire::StepRequest*, wire::RunStatus*) override;
  grpc::ServerUnaryReactor* SetSpeed(grpc::CallbackServerContext*, const wire::SpeedRequest*,
                                     wire::RunStatus*) override;
  grpc::ServerUnaryReactor* Stop(grpc::CallbackServerContext*, const wire::PanelRequest*, wire::RunStatus*) override;
  grpc::ServerUnaryReactor* Status(grpc::CallbackServerContext*, const wire::PanelRequest*, wire::RunStatus*) override;
  RawStream* Watch(grpc::CallbackServerContext*) override;
  ///@}

  /// Whether a panel waits for obey(): call with the lobby's mutex held.
  bool isAsked() const;
  /// Does what panels have asked, answers those whose steps are done, and tells those that watch. Call between steps.
  void obey(PanelDesk& desk);
  /// The run is over. May be called again.
  void sayGoodbye(PanelDesk& desk);

 private:
  class Call;
  template <typename Reactor>
  class ReactingCall;
  class LoadCall;
  class Watcher;
  using Wish = std::function<void(PanelDesk&, Call&)>;
  grpc::Status mayEnter(grpc::CallbackServerContext* context, Right right) const;
  grpc::ServerUnaryReactor* take(grpc::CallbackServerContext* context, Right right, std::uint32_t protocol,
                                 wire::RunStatus* reply, const char* what, Wish wish);
  void queue(const std::shared_ptr<Call>& call);
  void obey(PanelDesk& desk, Call& call);
  void answerSteppers(PanelDesk& desk);

  Lobby& lobby_;
  std::vector<std::shared_ptr<Call>> calls_;        ///< not yet obeyed; with the lobby's mutex held
  std::vector<std::shared_ptr<Watcher>> watchers_;  ///< with the lobby's mutex held
  std::vector<std::shared_ptr<Call>> steppers_;     ///< obeyed, and waiting for their last step
};

}  // namespace robosim
