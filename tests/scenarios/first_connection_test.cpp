// Clients that are started before the environment: --connect-timeout.
#include <fstream>

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include "tests/scenarios/program.h"
#include "tests/scenarios/serving.h"

namespace robosim {
namespace {

constexpr const char* kLine = " yet; waiting up to ";

/// An address at which nothing listens. It has an IP address of this process alone, so that other programs, to which
/// the system gives free ports of 127.0.0.1, do not get its port before the test uses it.
std::string unusedAddress() {
  constexpr in_addr_t kNetwork = 0x7f010000, kHosts = 0xffff;  // 127.1.0.0/16
  const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(kNetwork | (static_cast<in_addr_t>(getpid()) & kHosts));
  socklen_t size = sizeof address;
  EXPECT_EQ(bind(socket, reinterpret_cast<const sockaddr*>(&address), size), 0);
  EXPECT_EQ(getsockname(socket, reinterpret_cast<sockaddr*>(&address), &size), 0);
  close(socket);
  return std::string(inet_ntoa(address.sin_addr)) + ":" + std::to_string(ntohs(address.sin_port));
}

/// Starts a client, then, when it waits, the environment. @return result of the client
Ended serveLate(StartedProgram& client, const std::string& address, std::vector<std::string> serve_options) {
  client.waitForError("no environment listens at " + address +
                      " yet; waiting up to 600.0 s for it (--connect-timeout)\n");
  serve_options.insert(serve_options.begin(), {"serve", "worlds/small_maze.xml", "--listen", address});
  StartedProgram serve(serve_options);
  const Ended ended = client.wait();
  EXPECT_EQ(countOf(kLine, ended.err), 1u) << ended.err;
  serve.interrupt();
  serve.wait();
  return ended;
}

TEST(FirstConnection, RobotsWaitForTheEnvironment) {
  const std::string address = unusedAddress();
  StartedProgram robots(
      {"robot", "Pioneer1", "Scout1", "--environment", address, "--connect-timeout", "600", "--controller", "still"});
  const Ended ended = serveLate(robots, address, {"--wait-for-robots", "--time", "1"});
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_EQ(ended.out, "the run is over after 10 steps\n");
}

TEST(FirstConnection, RobotsInSeparateProcessesReportItOnce) {
  const std::string address = unusedAddress();
  StartedProgram robots({"robot", "Pioneer1", "Scout1", "--separate-processes", "--environment", address,
                         "--connect-timeout", "600", "--controller", "still"});
  const Ended ended = serveLate(robots, address, {"--wait-for-robots", "--time", "1"});
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
}

TEST(FirstConnection, ControlPanelsAndViewersWaitForTheEnvironment) {
  const std::string address = unusedAddress();
  StartedProgram panel({"control", address, "status", "--connect-timeout", "600"});
  const Ended status = serveLate(panel, address, {"--paused"});
  EXPECT_EQ(status.exit_code, 0) << status.err;
  EXPECT_NE(status.out.find("paused at step 0"), std::string::npos) << status.out;
  const auto picture = emptyFolder() / "view.png";
  StartedProgram viewer({"view", address, "--connect-timeout", "600", "--offscreen", picture.string()});
  const Ended view = serveLate(viewer, address, {"--paused"});
  EXPECT_EQ(view.exit_code, 0) << view.err;
  EXPECT_TRUE(std::filesystem::exists(picture));
}

TEST(FirstConnection, CtrlCEndsTheWait) {
  StartedProgram robot({"robot", "Pioneer1", "--environment", unusedAddress(), "--connect-timeout", "600"});
  robot.waitForError(kLine);
  robot.interrupt();
  const Ended ended = robot.wait();
  EXPECT_EQ(ended.exit_code, 130);
  EXPECT_NE(ended.err.find("robosim robot: interrupted; no environment listens at "), std::string::npos) << ended.err;
}

TEST(FirstConnection, FailsAfterItsTimeout) {
  const std::string address = unusedAddress();
  const Ended ended = runProgram("control " + address + " status --connect-timeout 2");
  EXPECT_EQ(ended.exit_code, 2);
  EXPECT_EQ(countOf(kLine, ended.err), 1u) << ended.err;
  EXPECT_NE(ended.err.find("robosim control status: no environment answers at " + address), std::string::npos)
      << ended.err;
}

TEST(FirstConnection, DoesNotWaitForAnEnvironmentThatRefuses) {
  const auto folder = emptyFolder();
  std::ofstream(folder / "tokens") << "a-token-of-an-operator-0123456789 operator\n";
  std::ofstream(folder / "token") << "another-token-0123456789-01234567\n";
  ASSERT_EQ(runCommand("chmod 600 " + quoted(folder / "tokens") + " " + quoted(folder / "token")).exit_code, 0);
  Serving serving({"--paused", "--tokens", (folder / "tokens").string()});
  const std::string status = "control " + serving.address() + " status --connect-timeout 600 ";
  for (const std::string& options : {"--token-file " + quoted(folder / "token"), std::string("--tls")}) {
    const Ended ended = runProgram(status + options);
    EXPECT_EQ(ended.exit_code, 2) << options;
    EXPECT_EQ(countOf(kLine, ended.err), 0u) << ended.err;
  }
}

}  // namespace
}  // namespace robosim
