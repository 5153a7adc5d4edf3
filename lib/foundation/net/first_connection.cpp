#include "net/first_connection.h"

#include <algorithm>
#include <thread>

#include "base/interrupt.h"
#include "base/seconds.h"
#include "base/text_table.h"
#include "net/tls.h"

namespace robosim {
namespace {

using Clock = std::chrono::steady_clock;

/// Interval of attempts, and of checks for an interrupt.
constexpr std::chrono::milliseconds kConnectInterval{100};

/// Waits until the first attempt of a channel has succeeded or failed. @return whether it is connected
bool isConnected(grpc::Channel& channel, Clock::time_point until) {
  for (;;) {
    const grpc_connectivity_state state = channel.GetState(true);
    if (state == GRPC_CHANNEL_READY) return true;
    if (state == GRPC_CHANNEL_TRANSIENT_FAILURE || Clock::now() >= until) return false;
    throwIfInterrupted("the environment has not answered");
    channel.WaitForStateChange(state, std::chrono::system_clock::now() + kConnectInterval);
  }
}

}  // namespace

ConnectOptions waitForServer(ConnectOptions options, Seconds timeout,
                             const std::function<void(const std::string&)>& log) {
  if (timeout.count() <= 0) return options;
  const auto until = Clock::now() + fromSeconds(timeout.count());
  {
    // The channel is not used after a failure: its next attempt would wait for gRPC's back-off, and a call would fail
    // in the meantime.
    ConnectOptions trial = options;
    trial.shares_connections = false;
    auto channel = connect(trial);
    if (isConnected(*channel, until)) {
      options.channel = std::move(channel);
      return options;
    }
  }
  const auto remaining = [&] { return std::chrono::duration_cast<std::chrono::milliseconds>(until - Clock::now()); };
  bool is_logged = false;
  while (remaining().count() > 0 && !isListening(options.address, std::min(options.connect_limit, remaining()))) {
    if (!is_logged) {
      log("no environment listens at " + options.address + " yet; waiting up to " + fixed(timeout.count(), 1) +
          " s for it (--connect-timeout)");
    }
    is_logged = true;
    std::this_thread::sleep_for(std::min(kConnectInterval, remaining()));
    throwIfInterrupted("no environment listens at " + options.address);
  }
  return options;
}

}  // namespace robosim
