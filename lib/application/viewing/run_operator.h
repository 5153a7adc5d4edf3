#pragma once
#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>

#include "client/control_panel.h"

namespace robosim {

/// Client of a served run's control panel for a window. A thread sends the operations in order, so that the window
/// never blocks on the environment, and polls the run's status, which other clients may change. Refused operations are
/// reported on the terminal.
class RunOperator {
 public:
  /// Queries the status of the run.
  /// @throws ConnectionError
  explicit RunOperator(const ConnectOptions& connect_options);
  /// Does not wait for pending responses.
  ~RunOperator();
  RunOperator(const RunOperator&) = delete;
  RunOperator& operator=(const RunOperator&) = delete;

  void pause(bool paused);
  void step();
  void setSpeed(double speed);  ///< simulated seconds per second; 0: unlimited

  /// @name The last requested state; after the response, the state reported by the environment
  ///@{
  bool isPaused() const;
  double speed() const;
  ///@}

 private:
  using Operation = std::function<v1::RunStatus(ControlPanel&)>;
  void send(Operation operation);
  void work();
  void store(const v1::RunStatus& status);

  ControlPanel panel_;
  mutable std::mutex mutex_;  ///< guards the members below
  std::condition_variable condition_;
  std::deque<Operation> operations_;  ///< the first has been sent
  bool is_paused_ = false;
  double speed_ = 1;
  bool is_stopping_ = false;
  std::thread thread_;
};

}  // namespace robosim
