#include "net/audit.h"

#include <array>
#include <ctime>

#include "base/printable_text.h"

namespace robosim {

std::string auditLine(const Identity& client, const std::string& peer, const std::string& action,
                      Access::Clock::time_point when) {
  const std::time_t seconds = Access::Clock::to_time_t(when);
  std::tm utc{};
  gmtime_r(&seconds, &utc);
  std::array<char, sizeof "2027-01-31T18:00:00Z"> time{};
  std::strftime(time.data(), time.size(), "%FT%TZ", &utc);
  return std::string("audit: ") + time.data() + " " + client.name() + " (" + printableText(peer) +
         "): " + printableText(action);
}

}  // namespace robosim
