#include "net/access.h"

#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "base/error_list.h"
#include "base/scratch_folder.h"

namespace robosim {
namespace {

const char* const kTokens =
    "# who may come in\n"
    "\n"
    "viewer-0123456789abcdef viewer\n"
    "robots-0123456789abcdef robot Robo \"Scouty the Second\"\n"
    "master-0123456789abcdef operator\n";
const char* const kViewer = "viewer-0123456789abcdef";
const char* const kRobots = "robots-0123456789abcdef";
const char* const kOperator = "master-0123456789abcdef";

grpc::StatusCode codeOf(const char* token, Right right, std::vector<std::string> robots = {}) {
  return Access::parse(kTokens, "tokens").check(token, right, robots).error_code();
}

std::string errorOf(const std::string& text) {
  try {
    Access::parse(text, "tokens");
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "";
}

TEST(Access, WithoutTokensLetsEveryoneDoEverything) {
  EXPECT_TRUE(Access().isOpen());
  EXPECT_TRUE(Access().check(std::nullopt, Right::operate).ok());
}

TEST(Access, LetsAViewerLookAndNoMore) {
  EXPECT_EQ(codeOf(kViewer, Right::look), grpc::StatusCode::OK);
  for (const Right right : {Right::drive, Right::work, Right::operate}) {
    EXPECT_EQ(codeOf(kViewer, right), grpc::StatusCode::PERMISSION_DENIED);
  }
}

TEST(Access, LetsARobotsProcessDriveItsRobotsAndNoMore) {
  EXPECT_EQ(codeOf(kRobots, Right::drive), grpc::StatusCode::OK) << "as long as it has not said which";
  EXPECT_EQ(codeOf(kRobots, Right::drive, {"Robo"}), grpc::StatusCode::OK);
  EXPECT_EQ(codeOf(kRobots, Right::drive, {"Scouty the Second", "Robo"}), grpc::StatusCode::OK);
  EXPECT_EQ(codeOf(kRobots, Right::drive, {"Robo", "Other"}), grpc::StatusCode::PERMISSION_DENIED);
  for (const Right right : {Right::look, Right::work, Right::operate}) {
    EXPECT_EQ(codeOf(kRobots, right), grpc::StatusCode::PERMISSION_DENIED);
  }
}

TEST(Access, LetsAnOperatorDoEverything) {
  for (const Right right : {Right::look, Right::drive, Right::work, Right::operate}) {
    EXPECT_EQ(codeOf(kOperator, right, {"Other"}), grpc::StatusCode::OK);
  }
}

TEST(Access, RefusesWhoShowsNoTokenOrAnUnknownOneAndSaysTheMend) {
  const Access access = Access::parse(kTokens, "tokens");
  const grpc::Status none = access.check(std::nullopt, Right::look);
  EXPECT_EQ(none.error_code(), grpc::StatusCode::UNAUTHENTICATED);
  EXPECT_NE(none.error_message().find("--token-file"), std::string::npos);
  for (const char* wrong : {"", "viewer-0123456789abcde", "viewer-0123456789abcdef0"}) {
    const grpc::Status unknown = access.check(wrong, Right::look);
    EXPECT_EQ(unknown.error_code(), grpc::StatusCode::UNAUTHENTICATED);
    EXPECT_EQ(unknown.error_message().find("viewer-"), std::string::npos) << "a token is never told";
  }
}

TEST(Access, SaysWhichLineOfTheFileIsWrongWithoutTellingTheToken) {
  const std::string wrong = errorOf(
      "short viewer\n"
      "0123456789abcdefghij king\n"
      "1123456789abcdefghij robot\n"
      "2123456789abcdefghij viewer Robo\n"
      "2123456789abcdefghij operator\n"
      "3123456789abcdefghij\n");
  for (const char* line : {"tokens:1: the token must have 16", "tokens:2: after the token must stand its role",
                           "tokens:3: the role robot needs names", "tokens:4: only the role robot takes names",
                           "tokens:5: the token stands in an earlier line", "tokens:6: after the token must stand"}) {
    EXPECT_NE(wrong.find(line), std::string::npos) << line << "\n" << wrong;
  }
  for (const char* token : {"short", "23456789"}) EXPECT_EQ(wrong.find(token), std::string::npos) << wrong;
  EXPECT_NE(errorOf("# none\n").find("has no token"), std::string::npos);
}

TEST(Access, RefusesAFileThatOthersMayRead) {
  const ScratchFolder folder;
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
  EXPECT_TRUE(Access::read(file).check(kViewer, Right::look).ok());
}

TEST(Access, SaysWhenItsFileCannotBeRead) {
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
