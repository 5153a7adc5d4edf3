#pragma once
#include <functional>
#include <memory>
#include <vector>

#include "net/control_panel.grpc.pb.h"
#include "net/switchboard.h"
#include "robots/world_source.h"
#include "server/lobby.h"
#include "server/run_switch.h"

namespace robosim {

/// gRPC's base for it.
using ControlPanelService = wire::ControlPanel::WithRawMethod_Load<
    wire::ControlPanel::WithRawMethod_Watch<wire::ControlPanel::WithAsyncMethod_Start<
        wire::ControlPanel::WithAsyncMethod_Pause<wire::ControlPanel::WithAsyncMethod_Step<
            wire::ControlPanel::WithAsyncMethod_SetSpeed<wire::ControlPanel::WithAsyncMethod_Stop<
                wire::ControlPanel::WithAsyncMethod_Status<wire::ControlPanel::Service>>>>>>>>;

/// What a control panel may touch.
struct PanelDesk {
  RunSwitch run_switch;
  /// Puts another world in place of the one that is run. @throws ConfigError when it is no good; the run then goes on.
  std::function<void(const WorldSource&)> load;
  /// Fills in how the run stands.
  std::function<void(wire::RunStatus&)> describe = [](wire::RunStatus&) {};
};

/// The conversation with control panels. Calls wait until obey(), between two steps: so nothing changes within a step,
/// and a status is of one moment.
class ControlPanelConversation final : public ControlPanelService {
 public:
  explicit ControlPanelConversation(Lobby& lobby);
  ~ControlPanelConversation() override;

  /// Lets panels come in.
  void open(const Switchboard::Line& line);
  /// Does what panels have asked, answers those whose steps are done, and tells those that watch. Call between steps.
  void obey(PanelDesk& desk);
  /// The run is over. May be called again.
  void sayGoodbye(PanelDesk& desk);

 private:
  class Call;
  template <typename Request>
  struct Kind;
  template <typename Request>
  class PlainCall;
  class LoadCall;
  class Watcher;
  template <typename Request>
  void awaitCall(const Kind<Request>& kind);
  void awaitLoad();
  void awaitWatcher();
  void queue(const std::shared_ptr<Call>& call);
  void obey(PanelDesk& desk, Call& call);
  void refuse(Call& call, const std::string& why);
  void answerSteppers(PanelDesk& desk);

  Lobby& lobby_;
  Switchboard::Line line_{};
  std::vector<std::shared_ptr<Call>> calls_;  ///< not yet obeyed
  std::vector<std::shared_ptr<Watcher>> watchers_;
  std::vector<std::shared_ptr<Call>> steppers_;  ///< obeyed, and waiting for their last step
};

}  // namespace robosim
