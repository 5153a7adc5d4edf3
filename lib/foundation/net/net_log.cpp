#include "net/net_log.h"

#include <algorithm>
#include <mutex>

#include <grpc/support/log.h>

#include "base/log.h"
#include "base/log_limiter.h"

namespace robosim {
namespace {

constexpr int kLinesPerSecond = 1;

/// Never destroyed: threads of gRPC may log until the process ends.
LogLimiter& limiter() {
  static auto* const the_limiter =
      new LogLimiter([](const std::string& line) { logWarning("", line); }, LogLimiter::Clock::now, kLinesPerSecond);
  return *the_limiter;
}

/// Each position in gRPC's source code that logs has its own limit, so that one kind of error does not hide another.
void logFromGrpc(gpr_log_func_args* logged) {
  std::string_view file = logged->file;
  file.remove_prefix(std::min(file.size(), file.rfind('/') + 1));
  const std::string kind = "gRPC (" + std::string(file) + ":" + std::to_string(logged->line) + ")";
  logFromNet(kind, kind + ": " + logged->message);
}

}  // namespace

void limitGrpcLog() {
  static std::once_flag is_done;
  std::call_once(is_done, [] { gpr_set_log_function(logFromGrpc); });
}

void logFromNet(std::string_view kind, const std::string& line) { limiter().write(kind, line); }

}  // namespace robosim
