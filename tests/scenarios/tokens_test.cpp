// Tokens at run time: deletion, expiry, guessing, and names in the audit log.
#include <csignal>
#include <fstream>

#include <gtest/gtest.h>

#include "tests/scenarios/panel.h"
#include "tests/scenarios/program.h"
#include "tests/scenarios/serving.h"

namespace robosim {
namespace {

const std::string kViewerToken = "viewer-0123456789abcdef";
const std::string kPioneerToken = "robots-0123456789abcdef";
const std::string kOperatorToken = "master-0123456789abcdef";
const std::string kAll = kViewerToken + " viewer name=vera\n" + kPioneerToken + " robot Pioneer1 name=pia\n" +
                         kOperatorToken + " operator name=olga\n";

struct Tokens : testing::Test {
  const std::filesystem::path folder = emptyFolder();

  std::filesystem::path write(const std::string& file, const std::string& text) const {
    const auto next = folder / (file + ".next");
    std::ofstream(next) << text;
    std::filesystem::permissions(next, std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
    std::filesystem::rename(next, folder / file);
    return folder / file;
  }
  std::string fileWith(const std::string& token) const { return write("of_" + token.substr(0, 6), token + "\n"); }
  std::vector<std::string> watching(const Serving& serving, const std::string& token) const {
    return {"control", serving.address(), "status", "--watch", "--interval", "0.05", "--token-file", fileWith(token)};
  }
};

TEST_F(Tokens, DeletedTokensEndTheirSessionsAtSighup) {
  Serving serving({"--tokens", write("tokens", kAll), "--wait-for-robots"});
  StartedProgram viewer(watching(serving, kViewerToken)), master(watching(serving, kOperatorToken));
  StartedProgram pioneer({"robot", "Pioneer1", "--controller", "still", "--environment", serving.address(),
                          "--token-file", fileWith(kPioneerToken)});
  viewer.waitForOutput("waits for robots");
  serving.program().waitForError("connected, with the token pia");
  write("tokens", kOperatorToken + " operator name=olga\n");
  serving.program().signal(SIGHUP);
  for (StartedProgram* client : {&viewer, &pioneer}) {
    const Ended ended = client->wait();
    EXPECT_EQ(ended.exit_code, 2);
    EXPECT_NE(ended.err.find("the token was withdrawn"), std::string::npos) << ended.err;
  }
  EXPECT_TRUE(master.isRunning());
  EXPECT_TRUE(serving.program().isRunning()) << "SIGHUP does not end it";
  serving.program().waitForError("tokens: read 1 from");
}

TEST_F(Tokens, DeletedOrExpiredTokensEndTheirSessions) {
  Serving serving({"--tokens", write("tokens", kAll), "--paused"});
  StartedProgram viewer(watching(serving, kViewerToken)), master(watching(serving, kOperatorToken));
  viewer.waitForOutput("paused");
  master.waitForOutput("paused");
  write("tokens", kViewerToken + " viewer name=vera expires=2020-01-31\n");
  const Ended expired = viewer.wait(), withdrawn = master.wait();
  EXPECT_NE(expired.err.find("the token vera has expired"), std::string::npos) << expired.err;
  EXPECT_NE(withdrawn.err.find("the token was withdrawn"), std::string::npos) << withdrawn.err;
  serving.program().waitForError("tokens: vera has expired");
}

TEST_F(Tokens, StayInForceWhenTheNewFileIsInvalid) {
  Serving serving({"--tokens", write("tokens", kAll), "--paused"});
  StartedProgram viewer(watching(serving, kViewerToken));
  viewer.waitForOutput("paused");
  write("tokens", kViewerToken + " king\n");
  serving.program().signal(SIGHUP);
  serving.program().waitForError("stay in force");
  EXPECT_NE(serving.program().error().find("tokens:1: a role must follow the token"), std::string::npos);
  EXPECT_TRUE(viewer.isRunning());
  EXPECT_EQ(runProgram("control " + serving.address() + " status --token-file " + fileWith(kOperatorToken)).exit_code,
            0);
}

TEST_F(Tokens, AreNamedInTheAuditLog) {
  Serving serving({"--tokens", write("tokens", kAll), "--paused"});
  for (const std::string action : {"pause", "speed 2", "step 3", "start", "load worlds/opho2_1.xml", "stop"}) {
    const Ended ended =
        runProgram("control " + serving.address() + " " + action + " --token-file " + fileWith(kOperatorToken));
    EXPECT_EQ(ended.exit_code, 0) << action << ended.err;
  }
  const std::string log = serving.program().wait().err;
  for (const std::string action : {"pause\n", "speed 2.000000\n", "step 3\n", "start\n", "load opho2_1\n", "stop\n"}) {
    const auto at = log.find("): " + action);
    ASSERT_NE(at, std::string::npos) << action << log;
    const auto line = log.rfind('\n', at) + 1;
    EXPECT_EQ(log.substr(line, 21), "robosim serve: audit:") << log.substr(line, at - line);
    EXPECT_NE(log.substr(line, at - line).find("Z olga (ipv4:127.0.0.1:"), std::string::npos) << action;
  }
  EXPECT_EQ(log.find("0123456789abcdef"), std::string::npos) << "no token is ever logged";
}

TEST_F(Tokens, GuessingIsRateLimited) {
  ServedWorld::Options options = paused();
  const auto now = Access::Clock::now();  // a fixed time
  options.server.access = Access::parse(kAll, "tokens", {.now = [now] { return now; }});
  const ServedWorld world(options);
  const auto code = [&](const std::string& token) {
    ConnectOptions connect_options = world.connectOptions();
    connect_options.token = token;
    try {
      ControlPanel(connect_options).status();
      return grpc::StatusCode::OK;
    } catch (const ConnectionError& error) {
      return error.code();
    }
  };
  EXPECT_EQ(code(kOperatorToken), grpc::StatusCode::OK);
  for (int i = 0; i < 6; ++i) EXPECT_EQ(code("guess-" + std::to_string(i)), grpc::StatusCode::UNAUTHENTICATED);
  EXPECT_EQ(code("guess-6"), grpc::StatusCode::RESOURCE_EXHAUSTED);
  EXPECT_EQ(code(kViewerToken), grpc::StatusCode::RESOURCE_EXHAUSTED) << "it might be a guess";
  EXPECT_EQ(code(kOperatorToken), grpc::StatusCode::OK) << "it was accepted from this address before";
}

}  // namespace
}  // namespace robosim
