// The shipped configuration in doc/examples/reverse_proxy, in front of a server that is attacked through it.
#include <algorithm>
#include <fstream>
#include <future>
#include <regex>

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include "tests/scenarios/attacked_run.h"
#include "tests/scenarios/certificates.h"
#include "tests/scenarios/http2_peer.h"

namespace robosim {
namespace {

/// HAProxy with the shipped configuration, except for certificate, ports and, where a test waits for them, time limits.
class Proxy {
 public:
  explicit Proxy(const std::string& server, const std::string& idle_limit = "10s") : folder_(certificates()) {
    sockaddr_in own{};
    own.sin_family = AF_INET;
    own.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof own;
    auto* const plain = reinterpret_cast<sockaddr*>(&own);
    // HAProxy inherits the socket: the system chooses the port, and no other process can take it.
    listener_ = socket(AF_INET, SOCK_STREAM, 0);
    if (bind(listener_, plain, size) != 0 || listen(listener_, 100) != 0 || getsockname(listener_, plain, &size) != 0) {
      throw std::runtime_error("cannot listen for the proxy");
    }
    address_ = "127.0.0.1:" + std::to_string(ntohs(own.sin_port));

    std::ofstream(folder_ / "both.pem") << textOf(folder_ / "cert.pem") << textOf(folder_ / "key.pem");
    std::string config = textOf(ROBOSIM_SOURCE_DIR "/doc/examples/reverse_proxy/haproxy.cfg");
    const auto replace = [&](const std::string& old, const std::string& by) {
      EXPECT_EQ(countOf(old, config), 1u) << old;
      config.replace(config.find(old), old.size(), by);
    };
    replace("bind :3443", "bind fd@" + std::to_string(listener_));
    replace("crt /etc/haproxy/robosim.pem", "crt " + (folder_ / "both.pem").string());
    replace("server local 127.0.0.1:3000", "server local " + server);
    replace("http-keep-alive 10s", "http-keep-alive " + idle_limit);
    replace("http-request 10s", "http-request " + idle_limit);
    std::ofstream(folder_ / "haproxy.cfg") << config;
    program_ =
        std::make_unique<StartedProgram>("/usr/sbin/haproxy", std::vector<std::string>{"-f", folder_ / "haproxy.cfg"});
  }
  ~Proxy() { close(listener_); }
  Proxy(const Proxy&) = delete;
  Proxy& operator=(const Proxy&) = delete;

  const std::string& address() const { return address_; }
  /// Client options for a connection through the proxy.
  std::vector<std::string> clientOptions() const { return {address_, "--tls-ca", folder_ / "cert.pem"}; }
  StartedProgram& program() { return *program_; }

 private:
  std::filesystem::path folder_;
  int listener_ = -1;
  std::string address_;
  std::unique_ptr<StartedProgram> program_;
};

TEST(ReverseProxy, ForwardsALockstepRunAndControlCommands) {
  Serving serving({"--wait-for-robots", "--time", "20", "--json"});
  Proxy proxy(serving.address());
  std::vector<std::string> words{"robot", "Pioneer1", "Scout1", "--controller", "wander", "--environment"};
  for (const auto& option : proxy.clientOptions()) words.push_back(option);
  const Ended panel = runProgram("control " + proxy.address() + " pause --tls-ca " + proxy.clientOptions().back());
  EXPECT_EQ(panel.exit_code, 0) << panel.err << proxy.program().error();
  EXPECT_EQ(runProgram("control " + serving.address() + " start").exit_code, 0);
  StartedProgram robots(words);
  EXPECT_EQ(robots.wait().exit_code, 0) << robots.error();
  const std::string served = serving.program().wait().out;
  const std::string local = runProgram("run worlds/small_maze.xml --json --controller wander --time 20").out;
  const std::regex digest("\"digest\":\\s*\"[0-9a-f]{16}\"");
  std::smatch of_served, of_local;
  ASSERT_TRUE(std::regex_search(served, of_served, digest)) << served;
  ASSERT_TRUE(std::regex_search(local, of_local, digest)) << local;
  EXPECT_EQ(of_served.str(), of_local.str());
}

TEST(ReverseProxy, ShieldsTheServerFromRapidReset) {
  const std::size_t resets = isVerifying() ? 1'000'000 : 30'000;
  constexpr std::size_t kConnections = 3;
  std::vector<std::string> arguments{"--speed", "20"};  // 200 steps per second
  if (isVerifying()) arguments.insert(arguments.end(), {"--step-deadline", "1"});
  AttackedRun run(arguments);
  Proxy proxy(run.address());
  run.connectRobots(proxy.clientOptions());
  const double calm_pace = run.paceDuring([&] { run.waitForSteps(200); });
  const double calm_mib = run.residentMib();
  const double pace = run.paceDuring([&] {
    std::vector<std::future<void>> attackers;
    for (std::size_t i = 0; i < kConnections; ++i) {
      attackers.push_back(std::async(std::launch::async, [&] {
        for (std::size_t left = resets / kConnections; left > 0;) {
          Http2Peer peer(proxy.address(), Http2Peer::Security::tls);
          if (peer.sendPreface()) left -= std::min(left, 1 + peer.resetStreams(left));
        }
      }));
    }
    for (auto& attacker : attackers) attacker.wait();
  });
  std::cout << resets << " resets: " << calm_mib << " MiB before, " << run.residentMib() << " MiB after, proxy "
            << residentMib(proxy.program().process()) << " MiB; " << calm_pace << " steps/s before, " << pace
            << " steps/s during\n";
  EXPECT_LT(run.residentMib() - calm_mib, 100);
  EXPECT_TRUE(run.hasKeptAllRobots()) << run.server().error();
  if (isVerifying()) {
    EXPECT_GT(pace, calm_pace / 2);
  }
}

TEST(ReverseProxy, ClosesConnectionsWithoutACall) {
  Serving serving({"--paused"});
  Proxy proxy(serving.address(), "1s");
  Http2Peer silent(proxy.address(), Http2Peer::Security::tls);
  Http2Peer with_preface(proxy.address(), Http2Peer::Security::tls);
  EXPECT_TRUE(with_preface.sendPreface());
  silent.waitUntilClosed();
  with_preface.waitUntilClosed();
  EXPECT_EQ(runProgram("control " + serving.address() + " status").exit_code, 0);
}

}  // namespace
}  // namespace robosim
