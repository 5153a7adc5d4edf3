#include "base/label.h"

#include <utility>

namespace robosim {
namespace {

constexpr char kSeparator = '/';

/// The text before and after the first separator; `before` is all of it, and nothing after it, without one.
std::pair<std::string_view, std::string_view> splitAtSeparator(std::string_view text) {
  const auto at = text.find(kSeparator);
  if (at == std::string_view::npos) return {text, {}};
  return {text.substr(0, at), text.substr(at + 1)};
}

std::string separatorError(std::string_view text, const char* what) {
  if (text.find(kSeparator) == std::string_view::npos) return "";
  return std::string("must not contain '/', which separates robot and sensor in a recording; choose another ") + what;
}

}  // namespace

Label Label::parse(std::string_view text) {
  if (text.find(kSeparator) == std::string_view::npos) return {"", std::string(text), ""};
  const auto [robot, rest] = splitAtSeparator(text);
  const auto [sensor, part] = splitAtSeparator(rest);
  return {std::string(robot), std::string(sensor), std::string(part)};
}

std::string Label::withinRobot() const { return part.empty() ? sensor : sensor + kSeparator + part; }

std::string Label::text() const { return robot.empty() ? withinRobot() : robot + kSeparator + withinRobot(); }

std::string robotNameError(std::string_view name) { return separatorError(name, "name"); }

std::string sensorLabelError(std::string_view label) {
  for (const char* reserved : {kGroundTruth, kStatus, kInbox, kPoints}) {
    if (label == reserved) {
      return "is reserved for recordings (GROUND_TRUTH, STATUS, INBOX, POINTS); choose another label";
    }
  }
  return separatorError(label, "label");
}

}  // namespace robosim
