#include "benchmark/condition.h"

#include <limits>
#include <sstream>

#include "base/error_list.h"
#include "base/xml_element.h"

namespace robosim {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

[[noreturn]] void refuse(const std::string& text, const std::string& why) {
  throw ConfigError("condition '" + text + "': " + why +
                    "; give ideal, or noise or errors, loss=PROBABILITY and breakdown_s=SECONDS joined by '+', as in "
                    "noise+loss=0.3");
}

}  // namespace

Condition Condition::parse(const std::string& text) {
  Condition condition;
  if (text == "ideal") return condition;
  std::istringstream parts(text);
  bool is_empty = true;
  for (std::string part; std::getline(parts, part, '+'); is_empty = false) {
    const std::size_t equals = part.find('=');
    const std::string name = part.substr(0, equals);
    const double value = equals == std::string::npos ? kNone : parseNumber(part.substr(equals + 1)).value_or(kNone);
    if (part == "noise" || part == "errors") {
      if (condition.noise != AddedNoise::none) refuse(text, "noise and errors exclude each other");
      condition.noise = part == "noise" ? AddedNoise::typical : AddedNoise::all;
    } else if (part == "ideal") {
      refuse(text, "ideal stands alone");
    } else if (name == "loss") {
      if (condition.message_loss > 0) refuse(text, "loss is given twice");
      if (!(value > 0 && value <= 1)) refuse(text, "the loss must be a probability above 0, at most 1");
      condition.message_loss = value;
    } else if (name == "breakdown_s") {
      if (condition.breakdown_mean_s > 0) refuse(text, "breakdown_s is given twice");
      if (!(value >= 1 && value <= 1e9)) refuse(text, "breakdown_s must be 1 to 1e9 seconds");
      condition.breakdown_mean_s = value;
    } else {
      refuse(text, "'" + part + "' is not known");
    }
  }
  if (is_empty) refuse(text, "it is empty");
  return condition;
}

std::string Condition::text() const {
  std::string parts;
  const auto add = [&](const std::string& part) { parts += (parts.empty() ? "" : "+") + part; };
  if (noise != AddedNoise::none) add(noise == AddedNoise::all ? "errors" : "noise");
  if (message_loss > 0) add("loss=" + toText(message_loss));
  if (breakdown_mean_s > 0) add("breakdown_s=" + toText(breakdown_mean_s));
  return parts.empty() ? "ideal" : parts;
}

}  // namespace robosim
