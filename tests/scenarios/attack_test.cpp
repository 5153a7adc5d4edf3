// Attacks on a running server over loopback: the run continues, and the server answers afterwards. ROBOSIM_VERIFY=1
// selects long variants.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <filesystem>
#include <future>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "net/wire_error.h"
#include "remote/robot_link.h"
#include "robosim/v1/remote_control.grpc.pb.h"
#include "robosim/v1/viewing.pb.h"
#include "tests/scenarios/attacked_run.h"
#include "tests/scenarios/certificates.h"
#include "tests/scenarios/http2_peer.h"
#include "tests/scenarios/wait.h"

namespace robosim {
namespace {

constexpr std::uint8_t kData = 0, kHeaders = 1, kSettings = 4, kPing = 6, kContinuation = 9, kEndHeaders = 4;
const char* const kBanned =
    "it floods the server with HTTP/2 frames; for 30 s new connections are served after an authorised call only, those "
    "from 127.0.0.0/24 last";

int exitCodeOfStatus(const std::string& address, const std::string& options = "") {
  return runProgram("control " + address + " status " + options).exit_code;
}

TEST(Attack, AnswersAfterDescriptorExhaustion) {
  constexpr std::size_t kConnections = 400;
  StartedProgram server("/bin/sh", {"-c", "ulimit -n 200; exec '" ROBOSIM_PROGRAM
                                          "' serve worlds/small_maze.xml --listen :0 --paused --controller wander"});
  server.waitForError("listening on 127.0.0.1:");
  const std::string says = server.error();
  const auto at = says.find("127.0.0.1:");
  const std::string address = says.substr(at, says.find('\n', at) - at);
  {
    std::vector<std::unique_ptr<Http2Peer>> peers;
    for (std::size_t i = 0; i < kConnections; ++i) peers.push_back(std::make_unique<Http2Peer>(address));
    for (auto& peer : peers) peer->sendPreface();
    // Half of the 168 descriptors that are not reserved.
    server.waitForError("is closed: the limit of 84 connections without an authorised call is reached");
  }
  // Closed connections may still occupy descriptors for a moment.
  waitUntil("the server answers", [&] { return exitCodeOfStatus(address) == 0; });
}

std::set<int> descriptorsOf(pid_t process) {
  std::set<int> descriptors;
  for (const auto& entry : std::filesystem::directory_iterator("/proc/" + std::to_string(process) + "/fd")) {
    descriptors.insert(std::stoi(entry.path().filename().string()));
  }
  return descriptors;
}

TEST(Attack, RelayedConnectionsLeaveReservedDescriptorsFree) {
  constexpr int kConnections = 100, kDescriptors = 200, kReserved = 32;
  const auto folder = certificates();
  const std::string tls = "--tls-cert " + quoted(folder / "cert.pem") + " --tls-key " + quoted(folder / "key.pem");
  // With --health every connection with TLS is relayed, which takes three descriptors.
  StartedProgram server("/bin/sh", {"-c", "ulimit -n " + std::to_string(kDescriptors) +
                                              "; exec '" ROBOSIM_PROGRAM
                                              "' serve worlds/small_maze.xml --listen :0 --paused --controller wander "
                                              "--health " +
                                              tls});
  server.waitForError("listening on 127.0.0.1:");
  const std::set<int> others = descriptorsOf(server.process());  // may have been inherited
  const std::string says = server.error();
  const auto at = says.find("127.0.0.1:");
  const std::string address = says.substr(at, says.find('\n', at) - at);
  {
    std::vector<std::unique_ptr<Http2Peer>> peers;
    try {
      for (int i = 0; i < kConnections; ++i) {
        peers.push_back(std::make_unique<Http2Peer>(address, Http2Peer::Security::tls));
        if (peers.back()->sendPreface()) peers.back()->send(peers.back()->headersOf("/grpc.health.v1.Health/Check"));
      }
    } catch (const std::runtime_error&) {  // refused before the handshake
    }
    server.waitForError("refused: the limit of 200 descriptors is reached");
    for (const int descriptor : descriptorsOf(server.process())) {
      EXPECT_TRUE(descriptor < kDescriptors - kReserved || others.contains(descriptor)) << descriptor;
    }
  }
  waitUntil("the server answers",
            [&] { return exitCodeOfStatus(address, "--tls-ca " + quoted(folder / "cert.pem")) == 0; });
}

TEST(Attack, RateLimitsLogLinesForInvalidTls) {
  using Clock = std::chrono::steady_clock;
  const std::size_t connections = isVerifying() ? 20'000 : 500;
  const auto folder = certificates();
  Serving serving({"--paused", "--tls-cert", folder / "cert.pem", "--tls-key", folder / "key.pem"});
  const auto begin = Clock::now();
  for (std::size_t i = 0; i < connections; ++i) {
    Http2Peer peer(serving.address());
    if (peer.send("no TLS, but garbage \x1b[2J\n")) peer.waitUntilClosed();
  }
  const auto seconds = static_cast<std::size_t>(std::chrono::ceil<std::chrono::seconds>(Clock::now() - begin).count());
  const std::string log = serving.program().error();
  const std::size_t lines = countOf("\n", log);
  std::cout << connections << " connections in " << seconds << " s: " << lines << " lines of log\n";
  // Each place that logs it writes one line per second, and one about suppressed lines.
  constexpr std::size_t kPlaces = 3, kOwnLines = 10;
  EXPECT_LE(lines, kOwnLines + kPlaces * 2 * (seconds + 1)) << log;
  EXPECT_GT(countOf("connection closed: it does not begin with TLS", log), 0u) << log;
  EXPECT_EQ(countOf("\x1b", log), 0u);
  EXPECT_EQ(exitCodeOfStatus(serving.address(), "--tls-ca " + (folder / "cert.pem").string()), 0);
}

TEST(Attack, BoundsMemoryForAClientThatNeverReads) {
  const int requests = isVerifying() ? 200'000 : 2'000;
  AttackedRun run({"--speed", "20"});
  run.connectRobots();
  run.waitForSteps(20);
  const double calm_mib = run.residentMib();
  Http2Peer slow(run.address());
  // SETTINGS_INITIAL_WINDOW_SIZE (4) of 0: the server may send no message.
  ASSERT_TRUE(
      slow.send("PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n" + http2Frame(kSettings, 0, 0, std::string{0, 4, 0, 0, 0, 0})));
  v1::FrameRequest request;
  request.set_protocol(kProtocolVersion);
  const std::string message = request.SerializeAsString();
  const std::string grpc_message = std::string{0, 0, 0, 0, static_cast<char>(message.size())} + message;
  ASSERT_TRUE(slow.send(slow.headersOf("/robosim.v1.Viewing/Watch")));
  for (int i = 0; i < requests; ++i) {
    if (!slow.send(http2Frame(kData, 0, 1, grpc_message))) break;
    if (i * grpc_message.size() > 60'000) break;  // the server's flow control window
  }
  run.waitForSteps(isVerifying() ? 2'000 : 100);
  std::cout << calm_mib << " MiB before, " << run.residentMib() << " MiB after\n";
#ifndef __SANITIZE_ADDRESS__  // the sanitizer delays freeing of memory
  EXPECT_LT(run.residentMib() - calm_mib, 50);
#endif
  EXPECT_TRUE(run.hasKeptAllRobots()) << run.server().error();
}

TEST(Attack, SilentConnectionsDoNotDelayOtherClients) {
  const std::size_t connections = isVerifying() ? 900 : 100;
  AttackedRun run({"--speed", "20"});
  run.connectRobots();
  std::vector<std::unique_ptr<Http2Peer>> silent, with_preface, with_call;
  for (std::size_t i = 0; i < connections / 3; ++i) {
    silent.push_back(std::make_unique<Http2Peer>(run.address()));
    with_preface.push_back(std::make_unique<Http2Peer>(run.address()));
    EXPECT_TRUE(with_preface.back()->sendPreface());
    with_call.push_back(std::make_unique<Http2Peer>(run.address()));
    EXPECT_TRUE(with_call.back()->sendPreface());
    EXPECT_TRUE(with_call.back()->send(with_call.back()->headersOf("/robosim.v1.Viewing/Watch")));
  }
  run.waitForSteps(100);
  EXPECT_TRUE(run.hasKeptAllRobots()) << run.server().error();
  if (!isVerifying()) return;  // takes 10 s
  for (auto& peer : silent) peer->waitUntilClosed();
  for (auto& peer : with_preface) peer->waitUntilClosed();
  for (auto& peer : with_call) peer->waitUntilClosed();  // first the call, then the connection without a call
  EXPECT_TRUE(run.hasKeptAllRobots()) << run.server().error();
}

TEST(Attack, DisconnectsRapidResetAndBansItsNetwork) {
  const std::size_t connections = isVerifying() ? 3 : 1;
  constexpr std::size_t kResets = 1'000'000;
  std::vector<std::string> arguments{"--speed", "20"};  // 200 steps a second
  if (isVerifying()) arguments.insert(arguments.end(), {"--step-deadline", "1"});
  AttackedRun run(arguments);
  run.connectRobots();
  const double calm_pace = run.paceDuring([&] { run.waitForSteps(200); });
  const double calm_mib = run.residentMib();
  std::atomic<std::size_t> resets{0};
  const double pace = run.paceDuring([&] {
    std::vector<std::future<void>> attackers;
    for (std::size_t i = 0; i < connections; ++i) {
      attackers.push_back(std::async(std::launch::async, [&] {
        Http2Peer attacker(run.address());
        if (attacker.sendPreface()) resets += attacker.resetStreams(kResets);
        EXPECT_TRUE(attacker.isClosed());
      }));
    }
    for (auto& attacker : attackers) attacker.wait();
    run.waitForSteps(isVerifying() ? 2'000 : 20);
  });
  std::cout << resets << " resets: " << calm_mib << " MiB before, " << run.residentMib() << " MiB after; " << calm_pace
            << " steps/s before, " << pace << " steps/s\n";
  EXPECT_LT(resets, connections * kResets);
  EXPECT_LT(run.residentMib() - calm_mib, 480);
  EXPECT_TRUE(run.hasKeptAllRobots()) << run.server().error();
  EXPECT_GT(countOf(kBanned, run.server().error()), 0u) << run.server().error();
  EXPECT_EQ(exitCodeOfStatus(run.address()), 0) << "a call from the banned network is served";
  if (isVerifying()) {
    EXPECT_GT(pace, calm_pace / 2);
  }
}

/// Frames of each kind that carry no message, after a preface.
std::map<std::string, std::string> floods() {
  const auto times = [](const std::string& once, int count) {
    std::string all;
    for (int i = 0; i < count; ++i) all += once;
    return all;
  };
  constexpr int kFrames = 1000;
  return {{"empty DATA", http2Frame(kHeaders, kEndHeaders, 1, "") + times(http2Frame(kData, 0, 1, ""), kFrames)},
          {"empty CONTINUATION", http2Frame(kHeaders, 0, 1, "") + times(http2Frame(kContinuation, 0, 1, ""), kFrames)},
          {"PING", times(http2Frame(kPing, 0, 0, std::string(8, '\0')), kFrames)}};
}

TEST(Attack, DisconnectsFloodsOfEveryKindAndServesTheOperator) {
  AttackedRun run({"--speed", "20"});
  run.connectRobots();
  for (const auto& [kind, frames] : floods()) {
    std::vector<std::unique_ptr<Http2Peer>> attackers;
    for (int i = 0; i < 20; ++i) {
      attackers.push_back(std::make_unique<Http2Peer>(run.address()));
      if (attackers.back()->sendPreface()) attackers.back()->send(frames);
    }
    EXPECT_EQ(exitCodeOfStatus(run.address()), 0) << kind;
    run.waitForSteps(20);
    for (auto& attacker : attackers) attacker->waitUntilClosed();
  }
  EXPECT_GT(countOf(kBanned, run.server().error()), 0u) << run.server().error();
  EXPECT_TRUE(run.hasKeptAllRobots()) << run.server().error();
}

/// Floods a server over one connection after the other, on a thread of its own, for its lifetime.
class ReconnectingFlood {
 public:
  ReconnectingFlood(const std::string& address, const std::string& frames)
      : thread_([this, address, frames] {
          while (!is_over_) {
            Http2Peer peer(address);
            if (peer.sendPreface() && peer.send(frames)) peer.waitUntilClosed();
          }
        }) {}
  ~ReconnectingFlood() {
    is_over_ = true;
    thread_.join();
  }
  ReconnectingFlood(const ReconnectingFlood&) = delete;
  ReconnectingFlood& operator=(const ReconnectingFlood&) = delete;

 private:
  std::atomic<bool> is_over_{false};
  std::thread thread_;
};

/// Observes a robot at its remote port.
class RemoteObserver {
 public:
  RemoteObserver(const std::string& robot, const std::string& address)
      : link_(robot, optionsFor(address), [this] {
          ++news_;
          news_.notify_all();
        }) {
    link_.setLive(true);
    link_.claim("Anna", true);
    link_.connect();
  }
  void waitForUpdates(std::size_t count) {
    for (std::shared_ptr<const RobotUpdate> seen; count > 0;) {
      const int news = news_;
      if (const auto update = link_.news().update; update != seen) {
        seen = update;
        --count;
      } else {
        news_.wait(news);
      }
    }
  }
  bool isUp() const { return link_.news().is_up; }

 private:
  static ConnectOptions optionsFor(const std::string& address) {
    ConnectOptions options;
    options.address = address;
    return options;
  }
  std::atomic<int> news_{0};
  RobotLink link_;
};

/// The address of the remote port that a program announces.
std::string remotePortOf(StartedProgram& robots) {
  const std::string announced = "remote control on ";
  robots.waitForError(announced);
  const std::string log = robots.error();
  const auto at = log.find(announced) + announced.size();
  return log.substr(at, log.find('\n', at) - at);
}

TEST(Attack, FloodsOfARemotePortDelayItsDriverByLessThanHalf) {
  using Clock = std::chrono::steady_clock;
  const std::size_t updates = isVerifying() ? 100 : 10;
  AttackedRun run({"--pace", "realtime"});
  StartedProgram robots({"robot", "Pioneer1", "Scout1", "--controller", "wander", "--environment", run.address(),
                         "--remote-port", "127.0.0.1:0"});
  const std::string address = remotePortOf(robots);
  RemoteObserver driver("Pioneer1", address);
  std::string headers;
  for (std::uint32_t stream = 1; stream < 2 * 10'000; stream += 2)
    headers += http2Frame(kHeaders, kEndHeaders, stream, "");
  for (const auto& [kind, frames] : {std::pair("PING", floods().at("PING")), std::pair("HEADERS", headers)}) {
    const auto begin = Clock::now();
    driver.waitForUpdates(updates);
    const std::chrono::duration<double> calm = Clock::now() - begin;
    const auto attacked = Clock::now();
    {
      const ReconnectingFlood first(address, frames), second(address, frames), third(address, frames);
      driver.waitForUpdates(updates);
    }
    const std::chrono::duration<double> flooded = Clock::now() - attacked;
    EXPECT_TRUE(driver.isUp()) << kind;
    EXPECT_EQ(countOf("has left", run.server().error()), 0u) << kind;
    if (!isVerifying()) continue;
    std::cout << kind << ": " << updates / flooded.count() << " of " << updates / calm.count() << " updates/s, "
              << residentMib(robots.process()) << " MiB\n";
    EXPECT_LT(flooded, 2 * calm) << kind;
  }
}

TEST(Attack, DisconnectsRapidResetAtARemotePort) {
  constexpr std::size_t kResets = 1'000'000;
  AttackedRun run({"--speed", "20"});
  StartedProgram robots({"robot", "Pioneer1", "Scout1", "--controller", "wander", "--environment", run.address(),
                         "--remote-port", "127.0.0.1:0"});
  const std::string address = remotePortOf(robots);
  run.waitForSteps(20);
  Http2Peer attacker(address);
  ASSERT_TRUE(attacker.sendPreface());
  EXPECT_LT(attacker.resetStreams(kResets, std::string("/") + v1::RemoteControl::service_full_name() + "/Control"),
            kResets);
  robots.waitForError(kBanned);
  run.waitForSteps(20);
}

}  // namespace
}  // namespace robosim
