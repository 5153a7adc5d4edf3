// Floods of clients without tokens: the run continues, and afterwards new clients can connect.
#include <atomic>
#include <future>

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include "net/flood_guard.h"
#include "robosim/v1/control_panel.grpc.pb.h"
#include "tests/scenarios/manual_clock.h"
#include "tests/scenarios/panel.h"
#include "tests/scenarios/robot_processes.h"
#include "tests/scenarios/served_world.h"

namespace robosim {
namespace {

/// Requests the status repeatedly, a thousand concurrent calls, until stopped.
class Flood {
 public:
  explicit Flood(const ConnectOptions& connect_options) : stub_(v1::ControlPanel::NewStub(connect(connect_options))) {
    for (int i = 0; i < 1000; ++i) ask();
  }
  /// @return number of answered calls
  std::size_t goOnUntil(const std::atomic<bool>& is_enough) {
    std::size_t answered = 0;
    void* tag = nullptr;
    for (bool ok = false; waiting_ > 0 && queue_.Next(&tag, &ok);) {
      const std::unique_ptr<Call> call(static_cast<Call*>(tag));
      --waiting_;
      ++answered;
      // Its connection is reset after flood_guard::kMaxRefusedCalls.
      const auto code = call->status.error_code();
      EXPECT_TRUE(code == grpc::StatusCode::UNAUTHENTICATED || code == grpc::StatusCode::UNAVAILABLE) << code;
      if (!is_enough) ask();
    }
    return answered;
  }

 private:
  struct Call {
    grpc::ClientContext context;
    v1::RunStatus reply;
    grpc::Status status;
    std::unique_ptr<grpc::ClientAsyncResponseReader<v1::RunStatus>> reader;
  };
  void ask() {
    v1::GetStatusRequest request;
    request.set_protocol(kProtocolVersion);
    auto* const call = new Call;
    call->reader = stub_->AsyncGetStatus(&call->context, request, &queue_);
    call->reader->Finish(&call->reply, &call->status, call);
    ++waiting_;
  }

  std::unique_ptr<v1::ControlPanel::Stub> stub_;
  grpc::CompletionQueue queue_;
  std::size_t waiting_ = 0;
};

TEST(Flood, UnauthenticatedCallsNeitherDelayRobotsNorFillTheLog) {
  ManualClock clock;  // not advanced: no deadline passes, and all is within one second
  ServedWorld::Options options;
  options.robots_elsewhere = true;
  options.server.is_paused = true;
  options.server.now = [&clock] { return clock.read(); };
  const std::string master = "master-0123456789ab", robots_token = "robots-0123456789ab";
  options.server.access = Access::parse(master + " operator\n" + robots_token + " robot Pioneer1 Scout1\n", "tokens");
  ServedWorld world(options);
  setenv("ROBOSIM_TOKEN", robots_token.c_str(), 1);
  const auto robots = startRobots({"Pioneer1", "Scout1"}, world.connectOptions().address);
  unsetenv("ROBOSIM_TOKEN");
  ConnectOptions connect_options = world.connectOptions();
  connect_options.token = master;
  ControlPanel panel(connect_options);
  panel.step(1);
  std::atomic<bool> is_enough{false};
  auto flood = std::async(std::launch::async, [&] { return Flood(world.connectOptions()).goOnUntil(is_enough); });
  world.waitForLog("refused: ");
  EXPECT_EQ(panel.step(100).step(), 101u);
  is_enough = true;
  EXPECT_GT(flood.get(), 100u);
  EXPECT_LE(countOf("refused: ", world.log()), 10u);
  flood_guard::endAlarm();  // the guard is global
}

TEST(Flood, ConnectionsBeyondTheDescriptorLimitDoNotBlockLaterClients) {
  StartedProgram server("/bin/sh", {"-c", "ulimit -Sn 64; exec '" ROBOSIM_PROGRAM
                                          "' serve worlds/small_maze.xml --listen :0 --paused --controller wander"});
  server.waitForError("listening on 127.0.0.1:");
  const std::string says = server.error();
  const int port = std::stoi(says.substr(says.find("127.0.0.1:") + 10));
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  std::vector<int> sockets;
  for (int i = 0; i < 100; ++i) {
    sockets.push_back(socket(AF_INET, SOCK_STREAM, 0));
    ASSERT_EQ(connect(sockets.back(), reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  }
  ConnectOptions connect_options;
  connect_options.address = "127.0.0.1:" + std::to_string(port);
  EXPECT_EQ(ControlPanel(connect_options).status().phase(), v1::RUN_PHASE_PAUSED);
  for (const int socket : sockets) close(socket);
  EXPECT_EQ(ControlPanel(connect_options).status().phase(), v1::RUN_PHASE_PAUSED);
}

}  // namespace
}  // namespace robosim
