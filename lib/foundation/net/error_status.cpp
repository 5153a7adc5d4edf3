#include "net/error_status.h"

#include <algorithm>
#include <array>

#include "base/printable_text.h"

namespace robosim {
namespace {

using grpc::StatusCode;

struct Reason {
  v1::ErrorReason reason;
  StatusCode code;
  bool is_transient = false;
};

constexpr std::array kReasons{
    Reason{v1::ERROR_REASON_INVALID_MESSAGE, StatusCode::INVALID_ARGUMENT},
    Reason{v1::ERROR_REASON_PROTOCOL_VERSION, StatusCode::FAILED_PRECONDITION},
    Reason{v1::ERROR_REASON_WORLD_VERSION, StatusCode::FAILED_PRECONDITION},
    Reason{v1::ERROR_REASON_OTHER_RUN, StatusCode::ABORTED},
    Reason{v1::ERROR_REASON_WORLD_REPLACED, StatusCode::ABORTED},
    Reason{v1::ERROR_REASON_RUN_OVER, StatusCode::UNAVAILABLE, true},
    Reason{v1::ERROR_REASON_UNKNOWN_ROBOT, StatusCode::NOT_FOUND},
    Reason{v1::ERROR_REASON_ROBOT_TAKEN, StatusCode::ALREADY_EXISTS, true},
    Reason{v1::ERROR_REASON_ROBOT_NOT_NETWORKED, StatusCode::FAILED_PRECONDITION},
    Reason{v1::ERROR_REASON_CONNECTION_REPLACED, StatusCode::ABORTED},
    Reason{v1::ERROR_REASON_STEP_DEADLINE, StatusCode::DEADLINE_EXCEEDED, true},
    Reason{v1::ERROR_REASON_FIRST_MESSAGE_DEADLINE, StatusCode::DEADLINE_EXCEEDED, true},
    Reason{v1::ERROR_REASON_LOAD_DEADLINE, StatusCode::DEADLINE_EXCEEDED, true},
    Reason{v1::ERROR_REASON_LOAD_IN_PROGRESS, StatusCode::RESOURCE_EXHAUSTED, true},
    Reason{v1::ERROR_REASON_INVALID_WORLD, StatusCode::INVALID_ARGUMENT},
    Reason{v1::ERROR_REASON_STEPS_INTERRUPTED, StatusCode::ABORTED},
    Reason{v1::ERROR_REASON_TOKEN_REQUIRED, StatusCode::UNAUTHENTICATED},
    Reason{v1::ERROR_REASON_TOKEN_INVALID, StatusCode::UNAUTHENTICATED},
    Reason{v1::ERROR_REASON_PERMISSION_DENIED, StatusCode::PERMISSION_DENIED},
    Reason{v1::ERROR_REASON_TOO_MANY_WRONG_TOKENS, StatusCode::RESOURCE_EXHAUSTED, true},
    Reason{v1::ERROR_REASON_CORRUPTED_MESSAGE, StatusCode::DATA_LOSS, true},
    Reason{v1::ERROR_REASON_WRONG_RESULT, StatusCode::FAILED_PRECONDITION},
    Reason{v1::ERROR_REASON_WORKERS_REJECTED, StatusCode::PERMISSION_DENIED},
    Reason{v1::ERROR_REASON_TOO_MANY_MESSAGES, StatusCode::INVALID_ARGUMENT},
    Reason{v1::ERROR_REASON_INTERNAL, StatusCode::INTERNAL},
    Reason{v1::ERROR_REASON_RECORDING_UNAVAILABLE, StatusCode::FAILED_PRECONDITION},
    Reason{v1::ERROR_REASON_CHANGE_REFUSED, StatusCode::FAILED_PRECONDITION},
};
static_assert(kReasons.size() == v1::ErrorReason_ARRAYSIZE - 1, "each reason has a code");

/// The text is in the status and in its details, and HTTP/2 limits the size of both together to 8 KiB.
constexpr std::size_t kMaxTextBytes = 1000;
/// A client may have sent a longer name.
constexpr std::size_t kMaxRobotBytes = 200;

}  // namespace

grpc::Status errorStatus(v1::ErrorReason reason, const std::string& text, const std::string& robot) {
  const auto* const known =
      std::find_if(kReasons.begin(), kReasons.end(), [&](const Reason& r) { return r.reason == reason; });
  const Reason entry = known == kReasons.end() ? Reason{reason, StatusCode::UNKNOWN} : *known;
  const std::string message = truncatedForStatus(printableLines(text));
  v1::ErrorDetail detail;
  detail.set_reason(reason);
  detail.set_is_transient(entry.is_transient);
  if (robot.size() <= kMaxRobotBytes) detail.set_robot(robot);
  v1::ErrorStatus status;
  status.set_code(entry.code);
  status.set_message(message);
  status.add_details()->PackFrom(detail);
  return {entry.code, message, status.SerializeAsString()};
}

std::optional<v1::ErrorDetail> detailOf(const grpc::Status& status) {
  v1::ErrorStatus details;
  if (status.error_details().empty() || !details.ParseFromString(status.error_details())) return std::nullopt;
  for (const auto& any : details.details()) {
    v1::ErrorDetail detail;
    if (any.UnpackTo(&detail)) return detail;
  }
  return std::nullopt;
}

v1::ErrorReason reasonOf(const grpc::Status& status) {
  const auto detail = detailOf(status);
  return detail ? detail->reason() : v1::ERROR_REASON_UNSPECIFIED;
}

bool isTransient(const grpc::Status& status) {
  if (const auto detail = detailOf(status)) return detail->is_transient();
  return status.error_code() == StatusCode::UNAVAILABLE || status.error_code() == StatusCode::DEADLINE_EXCEEDED ||
         status.error_code() == StatusCode::DATA_LOSS;
}

std::string truncatedForStatus(const std::string& text) {
  if (text.size() <= kMaxTextBytes) return text;
  std::size_t end = kMaxTextBytes;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;  // not within a UTF-8 character
  return text.substr(0, end) + " …";
}

}  // namespace robosim
