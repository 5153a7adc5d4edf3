#pragma once
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>

#include "net/control_panel.grpc.pb.h"
#include "net/dial.h"
#include "robots/world_source.h"

namespace robosim {

/// A control panel's end of the connection. The environment does each call between two steps; it returns how the run
/// stands after it. One call at a time.
/// @throws ConnectionError when nobody answers, or the environment will not do it.
class ControlPanel {
 public:
  explicit ControlPanel(const DialOptions& dial_options);
  ControlPanel(const ControlPanel&) = delete;
  ControlPanel& operator=(const ControlPanel&) = delete;

  wire::RunStatus start();
  wire::RunStatus pause();
  wire::RunStatus step(std::uint64_t steps);  ///< then a pause; returns when they are done
  wire::RunStatus setSpeed(double speed);     ///< simulated seconds a second; 0: as fast as it can
  /// Ends the run, and begins another with this world, paused.
  wire::RunStatus load(const WorldSource& world);
  wire::RunStatus stop();
  wire::RunStatus status();

  /// Calls `show` with a report again and again, until the run is over.
  void watch(std::chrono::duration<double> period, const std::function<void(const wire::RunStatus&)>& show);

  /// From any thread, for good: ends a call that waits, with a ConnectionError.
  void leave();

 private:
  class Call;
  template <typename Method, typename Request>
  wire::RunStatus call(Method method, Request request);
  void check(const grpc::Status& status) const;

  DialOptions dialled_;
  std::unique_ptr<wire::ControlPanel::Stub> stub_;
  std::mutex mutex_;                          ///< of what follows
  grpc::ClientContext* in_flight_ = nullptr;  ///< of the call that waits, if any
  bool has_left_ = false;
};

}  // namespace robosim
