#pragma once
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>

#include "base/seconds.h"
#include "net/client_call.h"
#include "net/connect.h"
#include "robosim/v1/control_panel.grpc.pb.h"
#include "robots/world_source.h"
#include "world/intervention.h"

namespace robosim {

/// Client of the ControlPanel service. The server executes each call between two steps and returns the status of the
/// run after it. One call at a time.
/// @throws ConnectionError when the server does not answer or refuses the call.
class ControlPanel {
 public:
  explicit ControlPanel(const ConnectOptions& connect_options);
  ControlPanel(const ControlPanel&) = delete;
  ControlPanel& operator=(const ControlPanel&) = delete;

  v1::RunStatus start();
  v1::RunStatus pause();
  v1::RunStatus step(std::uint64_t steps);  ///< takes `steps` steps, then pauses; returns after the last step
  v1::RunStatus setSpeed(double speed);     ///< simulated seconds per second; 0: unlimited
  /// Ends the run, and starts another with this world, paused.
  v1::RunStatus load(const WorldSource& world);
  v1::RunStatus setRecording(bool on);            ///< starts or stops the recording of the run
  v1::RunStatus supervise(const Change& change);  ///< changes the run from outside, before its next step
  v1::RunStatus stop();
  v1::RunStatus status();

  /// Calls `on_status` with the current status at once, then repeatedly, at least `min_interval` apart ([0, 3600] s;
  /// 50 ms if it is less), and with the last status when the run is over.
  void watch(Seconds min_interval, const std::function<void(const v1::RunStatus&)>& on_status);

  /// Cancels the call in flight, which throws a ConnectionError, and all later calls. Thread-safe.
  void leave() { cancellation_.cancel(); }

 private:
  template <typename Method, typename Request>
  v1::RunStatus call(Method method, Request request);
  void check(const grpc::Status& status) const;

  ConnectOptions connect_options_;
  std::unique_ptr<v1::ControlPanel::Stub> stub_;
  CallCancellation cancellation_;
};

}  // namespace robosim
