#include "live_page/live_messages.h"

#include <algorithm>
#include <map>
#include <utility>

#include "base/printable_text.h"

namespace robosim {
namespace {

constexpr std::size_t kReceivers_bytes = 60;  ///< of their names; further ones are left out
constexpr std::size_t kText_bytes = 200;

}  // namespace

void addMessages(const Fleet& fleet, const std::vector<const Readings*>& readings, std::vector<LiveEvent>& events) {
  std::map<std::pair<std::string, std::string>, std::string> sent;  // receivers, by sender and text
  for (std::size_t i = 0; i < std::min(readings.size(), fleet.robots.size()); ++i) {
    if (!readings[i]) continue;
    if (events.size() + sent.size() >= LiveEncoding::kMaxEvents) break;
    for (const auto& message : readings[i]->inbox) {
      std::string& receivers = sent[{message.from, message.text}];
      if (receivers.size() > kReceivers_bytes) continue;
      receivers += (receivers.empty() ? "" : ", ") + fleet.robots[i].info.name;
    }
  }
  for (const auto& [message, receivers] : sent) {
    const auto sender =
        std::find_if(fleet.robots.begin(), fleet.robots.end(),
                     [&name = message.first](const FleetRobot& robot) { return robot.info.name == name; });
    LiveEvent event{"message", std::nullopt, "to " + receivers + ": " + shortened(message.second, kText_bytes)};
    if (sender != fleet.robots.end()) event.robot = static_cast<std::size_t>(sender - fleet.robots.begin());
    events.push_back(std::move(event));
  }
}

}  // namespace robosim
