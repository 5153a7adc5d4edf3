#pragma once
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>

#include "client/control_panel.h"
#include "console/run_view.h"
#include "net/client_call.h"
#include "net/connect.h"
#include "robots/world_source.h"

namespace robosim {

/// State of the environment's run for the console, received as a control panel of the environment. Starts the next run
/// with the world that it receives as a viewer, and starts and stops the recording, if its token is an operator's.
class RunMonitor final : public RunSource {
 public:
  /// Time without a status after which the environment is considered gone.
  static constexpr std::chrono::milliseconds kSilence{1000};

  /// When restart() may replace the run.
  enum class Restart { after_end, at_any_time };

  explicit RunMonitor(ConnectOptions environment, Restart restart = Restart::after_end);
  ~RunMonitor() override;

  RunView newest() override;
  void restart(bool paused) override;
  void resume() override;
  void setRecording(bool on) override;

 private:
  using Clock = std::chrono::steady_clock;

  void watch();  ///< on its thread, as the functions that follow
  void receive(const v1::RunStatus& status);
  void requestSourceOnce();
  void operate();  ///< on its thread, as the functions that follow
  void restartOnce(bool paused);
  void resumeOnce();
  void recordOnce(bool on);
  /// Calls `call` with a control panel that the destructor cancels. @return why it has failed; empty if it has not
  template <typename Call>
  std::string attempt(const Call& call);

  ConnectOptions environment_;
  Restart restart_;
  CallCancellation viewing_, replacing_;  ///< one call each at a time: of the watcher, of the operator
  std::mutex mutex_;                      ///< guards the members that follow
  std::condition_variable condition_;
  RunView view_;
  std::optional<Clock::time_point> received_;  ///< time of the last status
  std::optional<WorldSource> source_;          ///< of the run that is over; nullopt before its end
  ControlPanel* watching_ = nullptr;           ///< null while there is none, as the next one
  ControlPanel* operating_ = nullptr;
  std::optional<bool> recording_request_;  ///< not executed yet, as the resumption
  bool resume_requested_ = false;
  bool restart_is_paused_ = false;  ///< of the restart that is requested
  bool is_over_ = false;
  std::thread watcher_, operator_;
};

}  // namespace robosim
