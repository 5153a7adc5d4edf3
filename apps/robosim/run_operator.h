#pragma once
#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>

#include "server/control_panel.h"

namespace robosim {

/// What a person does to a run that goes on elsewhere, from a window: a thread of its own sends one deed after the
/// other, so that the window waits for no environment; and again and again it asks how the run stands, for others
/// operate it, too. What the environment will not do is told on the terminal.
class RunOperator {
 public:
  /// Asks how the run stands.
  /// @throws ConnectionError
  explicit RunOperator(const DialOptions& dial_options);
  /// Waits for nobody's answer.
  ~RunOperator();
  RunOperator(const RunOperator&) = delete;
  RunOperator& operator=(const RunOperator&) = delete;

  void pause(bool paused);
  void step();
  void setSpeed(double speed);  ///< simulated seconds a second; 0: as fast as it can

  /// @name As a person has just asked for it, and then as the environment says
  ///@{
  bool isPaused() const;
  double speed() const;
  ///@}

 private:
  using Deed = std::function<wire::RunStatus(ControlPanel&)>;
  void send(Deed deed);
  void work();
  void keep(const wire::RunStatus& status);

  ControlPanel panel_;
  mutable std::mutex mutex_;  ///< of what follows
  std::condition_variable bell_;
  std::deque<Deed> deeds_;  ///< the first is on its way
  bool is_paused_ = false;
  double speed_ = 1;
  bool ends_ = false;
  std::thread thread_;
};

}  // namespace robosim
