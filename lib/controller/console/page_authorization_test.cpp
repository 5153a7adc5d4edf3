#include "console/page_authorization.h"

#include <map>
#include <set>

#include <gtest/gtest.h>

namespace robosim {
namespace {

using Type = PageMessage::Type;
using Result = Authorization::Result;

constexpr const char* kPageTokens =
    "viewer-0123456789abcdef viewer\n"
    "only-ann-0123456789abcdef robot Ann\n"
    "only-bob-0123456789abcdef robot Bob\n"
    "both-0123456789abcdef robot Ann Bob\n"
    "operator-0123456789abcdef operator\n"
    "geometry-0123456789abcdef geometry\n";
/// The columns of the table below.
constexpr std::array kColumns{"viewer-0123456789abcdef", "only-ann-0123456789abcdef", "only-bob-0123456789abcdef",
                              "both-0123456789abcdef",   "operator-0123456789abcdef", "geometry-0123456789abcdef"};

struct PageAuthorizationTest : testing::Test {
  Access access = Access::parse(kPageTokens, "tokens");

  Identity client(const std::string& token) const { return access.authenticate(token, "127.0.0.1").identity; }
  static PageMessage message(Type type, const std::string& robot = "") {
    PageMessage message;
    message.type = type;
    message.robot = robot;
    return message;
  }
  /// A page in control of Ann, which is connected.
  static PageState inControl() {
    return {.is_admitted = true, .holds_lock = true, .primary = "Ann", .is_primary_known = true, .is_switching = false};
  }
};

TEST_F(PageAuthorizationTest, PermitsEachMessageToTheRolesOfTheTable) {
  // viewer, robot Ann, robot Bob, robot Ann Bob, operator, geometry; the primary is Ann
  const std::map<Type, std::string> table{
      {ConsoleRequest::hello, "yes yes yes yes yes yes"}, {ConsoleRequest::ack, "yes yes yes yes yes yes"},
      {ConsoleRequest::ping, "yes yes yes yes yes yes"},  {ConsoleRequest::live, "yes yes yes yes yes yes"},
      {ConsoleRequest::map, "yes no no no yes no"},       {OrderType::req_heat, "yes yes yes yes yes yes"},
      {OrderType::req_laser, "yes yes yes yes yes yes"},  {OrderType::req_sonar, "yes yes yes yes yes yes"},
      {ConsoleRequest::take, "no yes no yes yes no"},     {ConsoleRequest::release, "yes yes yes yes yes yes"},
      {OrderType::drive, "no yes no yes yes no"},         {OrderType::accelerate, "no yes no yes yes no"},
      {OrderType::decelerate, "no yes no yes yes no"},    {OrderType::turn_left, "no yes no yes yes no"},
      {OrderType::turn_right, "no yes no yes yes no"},    {OrderType::stop, "no yes no yes yes no"},
      {OrderType::alive, "no yes no yes yes no"},         {OrderType::check_win, "no yes no yes yes no"},
      {OrderType::set_mode, "no yes no yes yes no"},      {ConsoleRequest::switch_primary, "no yes no yes yes no"},
      {ConsoleRequest::play_again, "no no no no yes no"}, {ConsoleRequest::record, "no no no no yes no"},
      {ConsoleRequest::join, "no yes no yes yes no"},     {ConsoleRequest::leave, "yes yes yes yes yes yes"},
      {ConsoleRequest::start, "no yes no yes yes no"},    {ConsoleRequest::skip, "no no no no yes no"},
  };
  for (const auto& row : pageMessageRows()) {
    ASSERT_TRUE(table.contains(row.type)) << "add a row for " << row.name;
    std::string results;
    for (const char* token : kColumns) {
      const auto result = authorize(access, client(token), inControl(), message(row.type)).result;
      results += results.empty() ? "" : " ";
      results += result == Result::permitted ? "yes" : result == Result::denied ? "no" : "?";
    }
    EXPECT_EQ(results, table.at(row.type)) << row.name;
  }
}

TEST_F(PageAuthorizationTest, PermitsASwitchOnlyToRobotsOfTheToken) {
  const auto result = [&](const char* token, const std::string& robot) {
    return authorize(access, client(token), inControl(), message(ConsoleRequest::switch_primary, robot));
  };
  EXPECT_EQ(result("both-0123456789abcdef", "Bob").result, Result::permitted);
  EXPECT_EQ(result("operator-0123456789abcdef", "Cid").result, Result::permitted);
  EXPECT_EQ(result("both-0123456789abcdef", "Cid").result, Result::denied);
  EXPECT_EQ(result("both-0123456789abcdef", "Cid").why, "Your token is not for Cid.");
  EXPECT_EQ(result("only-ann-0123456789abcdef", "Bob").result, Result::denied);
  EXPECT_EQ(result("only-bob-0123456789abcdef", "Bob").result, Result::denied) << "the primary is Ann";
}

TEST_F(PageAuthorizationTest, StatesWhyATokenDoesNotPermitAMessage) {
  const auto why = [&](const char* token, Type type) {
    return authorize(access, client(token), inControl(), message(type)).why;
  };
  EXPECT_EQ(why("viewer-0123456789abcdef", OrderType::drive), "Your token permits watching, not driving.");
  EXPECT_EQ(why("only-bob-0123456789abcdef", OrderType::drive), "Your token is not for Ann.");
  EXPECT_EQ(why("both-0123456789abcdef", ConsoleRequest::record), "Your token does not permit recording the run.");
  EXPECT_EQ(why("both-0123456789abcdef", ConsoleRequest::play_again), "Your token does not permit starting a run.");
  EXPECT_EQ(why("only-bob-0123456789abcdef", ConsoleRequest::map),
            "Your token does not permit the map, which shows true poses.");
}

TEST_F(PageAuthorizationTest, TreatsMessagesBeforeTheHelloAsProtocolErrors) {
  PageState state = inControl();
  state.is_admitted = state.holds_lock = false;
  for (const auto& row : pageMessageRows()) {
    const auto authorization = authorize(access, Identity(), state, message(row.type));
    const bool is_hello = row.type == Type(ConsoleRequest::hello);
    EXPECT_EQ(authorization.result, is_hello ? Result::permitted : Result::protocol_error) << row.name;
    EXPECT_EQ(authorization.why, is_hello ? "" : "the first message of a page must be its hello");
  }
}

/// The messages with a result in a state, for a token with every right.
std::set<std::string> typesWith(Result result, const PageState& state) {
  std::set<std::string> types;
  for (const auto& row : pageMessageRows()) {
    PageMessage message;
    message.type = row.type;
    if (authorize(Access(), Identity(), state, message).result == result) types.insert(row.name);
  }
  return types;
}

TEST_F(PageAuthorizationTest, IgnoresDrivingWithoutTheControlLock) {
  PageState state = inControl();
  state.holds_lock = false;
  EXPECT_EQ(typesWith(Result::ignored, state),
            (std::set<std::string>{"release", "drive", "accelerate", "decelerate", "turn_left", "turn_right", "stop",
                                   "alive", "check_win", "autonomous", "switch", "play_again", "record"}));
}

TEST_F(PageAuthorizationTest, IgnoresDrivingDuringASwitchButNeverAStop) {
  PageState state = inControl();
  state.is_switching = true;
  EXPECT_EQ(typesWith(Result::ignored, state),
            (std::set<std::string>{"take", "drive", "accelerate", "decelerate", "turn_left", "turn_right", "check_win",
                                   "autonomous", "switch"}));
}

TEST_F(PageAuthorizationTest, IgnoresSpeedsForARobotWhoseLimitsAreUnknown) {
  PageState state = inControl();
  state.is_primary_known = false;
  EXPECT_EQ(typesWith(Result::ignored, state), std::set<std::string>{"drive"});
}

TEST_F(PageAuthorizationTest, PermitsEverythingWithoutTokens) {
  EXPECT_EQ(typesWith(Result::permitted, inControl()).size(), PageMessage::kTypes);
}

TEST(PageAuthorizationExpiry, DeniesWhatAnExpiredTokenPermitted) {
  auto wall = Access::Clock::time_point(std::chrono::sys_days(std::chrono::year(2027) / 1 / 31));
  Access::Options options;
  options.now = [&] { return wall; };
  const Access access = Access::parse("driver-0123456789abcdef robot Ann expires=2027-01-31\n", "tokens", options);
  const Identity client = access.authenticate("driver-0123456789abcdef", "127.0.0.1").identity;
  const PageState state{.is_admitted = true, .holds_lock = true, .primary = "Ann", .is_primary_known = true};
  PageMessage drive;
  drive.type = OrderType::drive;
  EXPECT_EQ(authorize(access, client, state, drive).result, Result::permitted);
  wall += std::chrono::days(1);
  EXPECT_EQ(authorize(access, client, state, drive).result, Result::denied);
  EXPECT_FALSE(mayJoin(access, client));
}

TEST(PageAuthorizationRoles, AdmitsTokensThatPermitWatchingOrDriving) {
  const Access access = Access::parse(kPageTokens, "tokens");
  const auto joins = [&](const char* token) {
    return mayJoin(access, access.authenticate(token, "127.0.0.1").identity);
  };
  for (const char* token : kColumns) EXPECT_EQ(joins(token), std::string(token).substr(0, 8) != "geometry") << token;
}

}  // namespace
}  // namespace robosim
