#include "net/audit.h"

#include <gtest/gtest.h>

namespace robosim {
namespace {

TEST(AuditLine, HasTimeTokenNamePeerAndAction) {
  const Access access = Access::parse("token-0123456789abcdef operator name=anna\n", "tokens");
  const auto anna = access.authenticate("token-0123456789abcdef", "").identity;
  const auto when = std::chrono::sys_days{std::chrono::year{2027} / 1 / 31} + std::chrono::hours(18);
  EXPECT_EQ(auditLine(anna, "ipv4:192.0.2.7:4711", "load maze\n\x1b[2J.xml", when),
            "audit: 2027-01-31T18:00:00Z anna (ipv4:192.0.2.7:4711): load maze\\x0a\\x1b[2J.xml");
}

}  // namespace
}  // namespace robosim
