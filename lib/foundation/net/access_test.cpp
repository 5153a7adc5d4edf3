#include "net/access.h"

#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "base/error_list.h"
#include "base/temporary_directory.h"

namespace robosim {
namespace {

const char* const kTokens =
    "# tokens of all clients\n"
    "\n"
    "viewer-0123456789abcdef viewer\n"
    "robots-0123456789abcdef robot Robo \"Scouty the Second\"\n"
    "worker-0123456789abcdef geometry\n"
    "master-0123456789abcdef operator\n";
const char* const kViewer = "viewer-0123456789abcdef";
const char* const kRobots = "robots-0123456789abcdef";
const char* const kWorker = "worker-0123456789abcdef";
const char* const kOperator = "master-0123456789abcdef";

grpc::Status statusOf(const Access& access, std::optional<std::string_view> token, Right right,
                      const std::vector<std::string>& robots = {}) {
  const auto [status, client] = access.authenticate(token, "ipv4:192.0.2.7:4711");
  return status.ok() ? access.check(client, right, robots) : status;
}

grpc::Status statusOf(const char* token, Right right, const std::vector<std::string>& robots = {}) {
  return statusOf(Access::parse(kTokens, "tokens"), token, right, robots);
}

grpc::StatusCode codeOf(const char* token, Right right, std::vector<std::string> robots = {}) {
  return statusOf(token, right, robots).error_code();
}

std::string errorOf(const std::string& text) {
  try {
    Access::parse(text, "tokens");
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "";
}

TEST(Access, GrantsEveryRightWithoutTokens) {
  EXPECT_TRUE(Access().isOpen());
  EXPECT_TRUE(statusOf(Access(), std::nullopt, Right::operate).ok());
}

TEST(Access, PermitsAViewerOnlyToLook) {
  EXPECT_EQ(codeOf(kViewer, Right::look), grpc::StatusCode::OK);
  for (const Right right : {Right::drive, Right::work, Right::operate}) {
    EXPECT_EQ(codeOf(kViewer, right), grpc::StatusCode::PERMISSION_DENIED);
  }
}

TEST(Access, PermitsARobotTokenOnlyToDriveItsRobots) {
  EXPECT_EQ(codeOf(kRobots, Right::drive), grpc::StatusCode::OK) << "before it has named its robots";
  EXPECT_EQ(codeOf(kRobots, Right::drive, {"Robo"}), grpc::StatusCode::OK);
  EXPECT_EQ(codeOf(kRobots, Right::drive, {"Scouty the Second", "Robo"}), grpc::StatusCode::OK);
  EXPECT_EQ(codeOf(kRobots, Right::drive, {"Robo", "Other"}), grpc::StatusCode::PERMISSION_DENIED);
  for (const Right right : {Right::look, Right::work, Right::operate}) {
    EXPECT_EQ(codeOf(kRobots, right), grpc::StatusCode::PERMISSION_DENIED);
  }
}

TEST(Access, PermitsAnOperatorEverythingExceptGeometryWork) {
  for (const Right right : {Right::look, Right::drive, Right::operate}) {
    EXPECT_EQ(codeOf(kOperator, right, {"Other"}), grpc::StatusCode::OK);
  }
  const auto status = statusOf(kOperator, Right::work);
  EXPECT_EQ(status.error_code(), grpc::StatusCode::PERMISSION_DENIED);
  EXPECT_NE(status.error_message().find("use one of the role geometry"), std::string::npos);
}

TEST(Access, PermitsAGeometryWorkerOnlyToWork) {
  EXPECT_EQ(codeOf(kWorker, Right::work), grpc::StatusCode::OK);
  for (const Right right : {Right::look, Right::drive, Right::operate}) {
    EXPECT_EQ(codeOf(kWorker, right), grpc::StatusCode::PERMISSION_DENIED);
  }
}

TEST(Access, RefusesMissingAndUnknownTokensWithAFix) {
  const Access access = Access::parse(kTokens, "tokens");
  const grpc::Status none = statusOf(access, std::nullopt, Right::look);
  EXPECT_EQ(none.error_code(), grpc::StatusCode::UNAUTHENTICATED);
  EXPECT_NE(none.error_message().find("--token-file"), std::string::npos);
  for (const char* wrong : {"", "viewer-0123456789abcde", "viewer-0123456789abcdef0"}) {
    const grpc::Status unknown = statusOf(access, wrong, Right::look);
    EXPECT_EQ(unknown.error_code(), grpc::StatusCode::UNAUTHENTICATED);
    EXPECT_EQ(unknown.error_message().find("viewer-"), std::string::npos) << "a token must not be quoted";
  }
}

TEST(Access, ReportsInvalidLinesWithoutQuotingTokens) {
  const std::string wrong = errorOf(
      "short viewer\n"
      "0123456789abcdefghij king\n"
      "1123456789abcdefghij robot\n"
      "2123456789abcdefghij viewer Robo\n"
      "2123456789abcdefghij operator\n"
      "3123456789abcdefghij\n");
  for (const char* line :
       {"tokens:1: the token must have 16",
        "tokens:2: a role must follow the token: viewer, robot NAME…, geometry, operator, or supervisor",
        "tokens:3: the role robot needs names", "tokens:4: only the role robot takes names",
        "tokens:5: the token is already used in an earlier line", "tokens:6: a role must follow the token"}) {
    EXPECT_NE(wrong.find(line), std::string::npos) << line << "\n" << wrong;
  }
  for (const char* token : {"short", "23456789"}) EXPECT_EQ(wrong.find(token), std::string::npos) << wrong;
  EXPECT_NE(errorOf("# none\n").find("has no token"), std::string::npos);
}

TEST(Access, NamesTokensAndReportsErrorsInAttributes) {
  const Access access = Access::parse(
      "token-0123456789abcdef robot Robo name=robo-1 \"a=b\"\n"
      "other-0123456789abcdef viewer\n",
      "tokens");
  EXPECT_EQ(access.authenticate("token-0123456789abcdef", "").identity.name(), "robo-1");
  EXPECT_EQ(access.authenticate("other-0123456789abcdef", "").identity.name(), "line-2");
  EXPECT_TRUE(statusOf(access, "token-0123456789abcdef", Right::drive, {"a=b"}).ok());
  EXPECT_EQ(Access().authenticate(std::nullopt, "").identity.name(), "anyone");
  const std::string wrong = errorOf(
      "0123456789abcdefghij viewer name=a\n"
      "1123456789abcdefghij viewer name=a\n"
      "2123456789abcdefghij viewer name=b!\n"
      "3123456789abcdefghij viewer expires=2027-02-29\n"
      "4123456789abcdefghij viewer expires=tomorrow\n"
      "5123456789abcdefghij robot Robo expire=2027-01-31\n"
      "6123456789abcdefghij viewer expires=2027-01-31T24:00:00Z\n");
  for (const char* line : {"tokens:2: the name a is that of an earlier line", "tokens:3: name= must have 1 to 64",
                           "tokens:4: expires= must be a date", "tokens:5: expires= must be a date",
                           "tokens:6: a token has the attributes", "tokens:7: expires= must be a date"}) {
    EXPECT_NE(wrong.find(line), std::string::npos) << line << "\n" << wrong;
  }
}

/// A token file, the log, and a manual clock.
struct AccessFile : testing::Test {
  const TemporaryDirectory folder;
  const std::filesystem::path file = folder / "tokens";
  Access::Clock::time_point now = std::chrono::sys_days{std::chrono::year{2027} / 1 / 31};
  std::string log;
  bool is_reload_requested = false;

  void write(const std::string& text) const {
    std::ofstream(file) << text;
    std::filesystem::permissions(file, std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
  }
  Access access() {
    Access::Options options;
    options.log = [this](const std::string& line) { log += line + "\n"; };
    options.now = [this] { return now; };
    options.is_reload_requested = [this] { return std::exchange(is_reload_requested, false); };
    return Access::read(file, options);
  }
  void poll(const Access& access) {
    for (int i = 0; i < 2; ++i) {  // at the first check it may still be incomplete
      now += std::chrono::seconds(1);
      access.refresh();
    }
  }
};

TEST_F(AccessFile, RefusesATokenFromItsExpiryOn) {
  write(
      "days-0123456789abcdef viewer name=anna expires=2027-01-31\n"
      "hours-0123456789abcdef viewer expires=2027-01-31T18:00:00Z\n");
  const Access access = this->access();
  const Identity anna = access.authenticate("days-0123456789abcdef", "").identity;
  const auto version = access.refresh();
  now += std::chrono::hours(18) - std::chrono::seconds(1);
  EXPECT_TRUE(statusOf(access, "hours-0123456789abcdef", Right::look).ok());
  now += std::chrono::seconds(1);
  EXPECT_EQ(statusOf(access, "hours-0123456789abcdef", Right::look).error_code(), grpc::StatusCode::UNAUTHENTICATED);
  EXPECT_GT(access.refresh(), version) << "open sessions are to be checked";
  EXPECT_EQ(log, "tokens: line-2 has expired\n");
  EXPECT_TRUE(access.check(anna, Right::look).ok());
  now += std::chrono::hours(6);
  EXPECT_EQ(access.check(anna, Right::look).error_message(),
            "the token anna has expired; request another from the operator of the environment");
}

TEST_F(AccessFile, IsReloadedWhenItHasChanged) {
  write("first-0123456789abcdef operator name=first\nkept-0123456789abcdef operator name=kept\n");
  const Access access = this->access();
  const Identity first = access.authenticate("first-0123456789abcdef", "").identity;
  const Identity kept = access.authenticate("kept-0123456789abcdef", "").identity;
  const auto version = access.refresh();
  write("second-0123456789abcdef viewer name=second\nkept-0123456789abcdef viewer name=kept\n");
  poll(access);
  EXPECT_GT(access.refresh(), version);
  EXPECT_EQ(access.check(first, Right::look).error_code(), grpc::StatusCode::UNAUTHENTICATED) << "withdrawn";
  EXPECT_TRUE(statusOf(access, "second-0123456789abcdef", Right::look).ok());
  EXPECT_TRUE(access.check(kept, Right::look).ok());
  EXPECT_EQ(access.check(kept, Right::operate).error_code(), grpc::StatusCode::PERMISSION_DENIED) << "its new role";
  EXPECT_EQ(log, "tokens: read 2 from " + file.string() + " again\n");
}

TEST_F(AccessFile, IsReloadedAtOnceOnRequest) {
  write("first-0123456789abcdef viewer\n");
  const Access access = this->access();
  write("second-0123456789abcdef viewer\n");
  is_reload_requested = true;
  access.refresh();
  EXPECT_TRUE(statusOf(access, "second-0123456789abcdef", Right::look).ok());
}

TEST_F(AccessFile, KeepsTheTokensWhenTheNewFileIsInvalidOrMissing) {
  write("first-0123456789abcdef viewer\n");
  const Access access = this->access();
  write("first-0123456789abcdef king\n");
  poll(access);
  EXPECT_NE(log.find(file.string() + ":1: a role must follow the token"), std::string::npos) << log;
  EXPECT_NE(log.find("stay in force"), std::string::npos) << log;
  EXPECT_TRUE(statusOf(access, "first-0123456789abcdef", Right::look).ok());
  const std::string so_far = log;
  poll(access);
  EXPECT_EQ(log, so_far) << "reported once";
  std::filesystem::remove(file);
  poll(access);
  EXPECT_NE(log.find("cannot be read"), std::string::npos) << log;
  EXPECT_TRUE(statusOf(access, "first-0123456789abcdef", Right::look).ok());
  write("third-0123456789abcdef viewer\n");
  poll(access);
  EXPECT_FALSE(statusOf(access, "first-0123456789abcdef", Right::look).ok());
}

TEST_F(AccessFile, LimitsGuessesPerAddress) {
  write("right-0123456789abcdef viewer\nother-0123456789abcdef viewer\n");
  const Access access = this->access();
  const auto code = [&](const std::string& token, const char* peer) {
    return access.authenticate(token, peer).status.error_code();
  };
  EXPECT_EQ(code("right-0123456789abcdef", "ipv4:192.0.2.7:1"), grpc::StatusCode::OK);
  int looked_up = 0;
  for (int i = 0; i < 12'000; ++i) {  // within a second
    if (code("guess-" + std::to_string(i), "ipv4:192.0.2.7:2") == grpc::StatusCode::UNAUTHENTICATED) ++looked_up;
    now += std::chrono::microseconds(83);
  }
  EXPECT_EQ(looked_up, 8) << "5 at once, then after 0, 0.25 and 0.75 s";
  EXPECT_EQ(code("other-0123456789abcdef", "ipv4:192.0.2.7:3"), grpc::StatusCode::RESOURCE_EXHAUSTED);
  EXPECT_EQ(code("right-0123456789abcdef", "ipv4:192.0.2.7:3"), grpc::StatusCode::OK) << "accepted before";
  EXPECT_EQ(code("other-0123456789abcdef", "ipv4:192.0.2.8:4"), grpc::StatusCode::OK) << "another address";
  now += std::chrono::seconds(5);
  EXPECT_EQ(code("other-0123456789abcdef", "ipv4:192.0.2.7:3"), grpc::StatusCode::OK);
}

TEST(Access, RefusesAFileReadableByOthers) {
  const TemporaryDirectory folder;
  const auto file = folder / "tokens";
  std::ofstream(file) << kTokens;
  using std::filesystem::perms;
  for (const perms open : {perms::others_read, perms::group_read}) {
    std::filesystem::permissions(file, perms::owner_read | perms::owner_write | open);
    try {
      Access::read(file);
      ADD_FAILURE() << "read a file that is open to others";
    } catch (const ConfigError& error) {
      EXPECT_NE(std::string(error.what()).find("chmod 600 " + file.string()), std::string::npos) << error.what();
    }
  }
  std::filesystem::permissions(file, perms::owner_read | perms::owner_write);
  EXPECT_TRUE(statusOf(Access::read(file), kViewer, Right::look).ok());
}

TEST(Access, ReportsAnUnreadableFile) {
  for (const char* file : {"/no/such/tokens", "/"}) {
    try {
      Access::read(file);
      ADD_FAILURE();
    } catch (const ConfigError& error) {
      EXPECT_EQ(std::string(error.what()).find(file), 0u) << error.what();
    }
  }
}

}  // namespace
}  // namespace robosim
