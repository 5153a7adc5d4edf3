#pragma once
#include <string_view>

namespace robosim {

/// Redirects gRPC's log lines of the whole process to logFromNet(). gRPC logs each failed handshake; a peer that sends
/// garbage would otherwise cause about 7,000 lines per second. May be called again.
void limitGrpcLog();

/// Writes "robosim: LINE" to standard error, rate-limited: one line of each kind a second (LogLimiter). Thread-safe.
/// @param kind lines of one kind share a limit; must not contain text from a peer
/// @param line control characters are escaped (printableText)
void logFromNet(std::string_view kind, std::string_view line);

}  // namespace robosim
