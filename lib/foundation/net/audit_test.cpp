#include "net/audit.h"

#include <string>
#include <vector>

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

TEST(AuditLog, LimitsTheLinesOfEachTokenAndReportsTheNumberSuppressed) {
  const Access access =
      Access::parse("token-0123456789abcdef operator name=anna\ntoken-fedcba9876543210 operator name=bea\n", "tokens");
  const auto anna = access.authenticate("token-0123456789abcdef", "").identity;
  const auto bea = access.authenticate("token-fedcba9876543210", "").identity;
  std::vector<std::string> lines;
  LogLimiter::Clock::time_point now{std::chrono::seconds(100)};
  AuditLog audit([&](const std::string& line) { lines.push_back(line); }, [&] { return now; });
  for (int i = 0; i < AuditLog::kLinesPerSecond + 40; ++i) audit.write(anna, "peer", "pause");
  audit.write(bea, "peer", "start");
  ASSERT_EQ(lines.size(), AuditLog::kLinesPerSecond + 1u);
  EXPECT_TRUE(lines.front().ends_with(" anna (peer): pause")) << lines.front();
  EXPECT_TRUE(lines.back().ends_with(" bea (peer): start")) << lines.back();
  now += std::chrono::seconds(1);
  audit.reportSuppressed();
  EXPECT_EQ(lines.back(), "audit of anna: 40 more lines within 1 s suppressed (limit: 20 lines/s)");
  audit.write(anna, "peer", "stop");
  EXPECT_TRUE(lines.back().ends_with(" anna (peer): stop")) << lines.back();
}

}  // namespace
}  // namespace robosim
