#pragma once
#include <condition_variable>
#include <deque>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "client/control_panel.h"

namespace robosim {

/// Changes a served run for a window. A thread sends the changes in order, so that the window never blocks on the
/// environment.
class RunSupervisor {
 public:
  /// Connects with the first change.
  explicit RunSupervisor(const ConnectOptions& connect_options)
      : panel_(connect_options), connect_options_(connect_options) {}
  /// Does not wait for pending responses.
  ~RunSupervisor();
  RunSupervisor(const RunSupervisor&) = delete;
  RunSupervisor& operator=(const RunSupervisor&) = delete;

  void request(const Change& change);
  /// The answers since the last call, in the order of the requests: why the environment has refused a change; empty
  /// for one that it has made.
  std::vector<std::string> takeAnswers();
  /// Why the environment permits this client no changes; empty until it has refused one for this reason.
  std::string refusal() const;

 private:
  void work();
  std::string send(const Change& change);

  ControlPanel panel_;
  ConnectOptions connect_options_;
  mutable std::mutex mutex_;  ///< guards the members below
  std::condition_variable condition_;
  std::deque<Change> changes_;  ///< to be sent
  std::vector<std::string> answers_;
  std::string refusal_;
  bool is_stopping_ = false;
  std::thread thread_;  ///< runs from the first change on
};

}  // namespace robosim
