#pragma once
#include <chrono>
#include <functional>
#include <string>

#include "base/seconds.h"
#include "net/connect.h"

namespace robosim {

/// Connects to a server that may start later than its client: as long as nothing listens at the address, or the address
/// is unreachable, waits at most `timeout`. A server that refuses the client, such as for its token or without TLS, is
/// not waited for.
/// @param timeout 0 or less: returns at once
/// @param log receives one line when the client begins to wait
/// @return the options with the connection, if there is one; else the first call of the client reports the failure
/// @throws Interrupted when a signal has requested the end (Interrupt::signal())
ConnectOptions waitForServer(ConnectOptions options, Seconds timeout,
                             const std::function<void(const std::string&)>& log);

}  // namespace robosim
