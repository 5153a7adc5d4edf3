#pragma once
#include <string>
#include <string_view>

namespace robosim {

/// Redirects gRPC's log lines of the whole process to logFromNet(). gRPC logs each failed handshake; a peer that sends
/// garbage would otherwise cause about 7,000 lines per second. May be called again.
void limitGrpcLog();

/// Logs a warning, rate-limited: one record of each kind a second (LogLimiter). Thread-safe.
/// @param kind records of one kind share a limit; must not contain text from a peer
void logFromNet(std::string_view kind, const std::string& line);

}  // namespace robosim
