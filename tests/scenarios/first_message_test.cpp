// A streaming call without a first message is ended after the deadline, and every refused call is logged.
#include <array>
#include <functional>

#include <grpcpp/generic/generic_stub.h>
#include <gtest/gtest.h>

#include "net/wire_error.h"
#include "robosim/internal/geometry.grpc.pb.h"
#include "robosim/v1/control_panel.grpc.pb.h"
#include "robosim/v1/robots.grpc.pb.h"
#include "robosim/v1/viewing.grpc.pb.h"
#include "tests/scenarios/manual_clock.h"
#include "tests/scenarios/program.h"
#include "tests/scenarios/served_world.h"

namespace robosim {
namespace {

using namespace std::chrono_literals;

/// One call of each streaming method that sends no message.
struct SilentCalls {
  explicit SilentCalls(const ConnectOptions& connect_options) {
    const auto channel = connect(connect_options);
    const auto end = [](auto& stream) { return [&stream] { return stream->Finish(); }; };
    panel_stub = v1::ControlPanel::NewStub(channel);
    load = panel_stub->Load(&contexts[0], &status);
    viewing_stub = v1::Viewing::NewStub(channel);
    watch = viewing_stub->Watch(&contexts[1]);
    geometry_stub = internal::Geometry::NewStub(channel);
    work = geometry_stub->Work(&contexts[2]);
    robots_stub = v1::Robots::NewStub(channel);
    drive = robots_stub->Drive(&contexts[3]);
    generic_stub = std::make_unique<grpc::GenericStub>(channel);
    // A generated stub sends the request of a server-streaming call at once.
    status_watch = generic_stub->PrepareCall(&contexts[4], "/robosim.v1.ControlPanel/Watch", &queue);
    status_watch->StartCall(nullptr);
    waitForCompletion();
    finish = {{"ControlPanel.Load", end(load)},
              {"Viewing.Watch", end(watch)},
              {"Geometry.Work", end(work)},
              {"Robots.Drive", end(drive)},
              {"ControlPanel.Watch", [this] {
                 grpc::Status result;
                 status_watch->Finish(&result, nullptr);
                 waitForCompletion();
                 return result;
               }}};
  }
  ~SilentCalls() { queue.Shutdown(); }

  /// Waits for the only operation of the queue.
  void waitForCompletion() {
    void* tag = nullptr;
    bool ok = false;
    EXPECT_TRUE(queue.Next(&tag, &ok) && ok);
  }

  grpc::CompletionQueue queue;  ///< of status_watch
  std::array<grpc::ClientContext, 5> contexts;
  std::unique_ptr<v1::ControlPanel::Stub> panel_stub;
  std::unique_ptr<v1::Viewing::Stub> viewing_stub;
  std::unique_ptr<internal::Geometry::Stub> geometry_stub;
  std::unique_ptr<v1::Robots::Stub> robots_stub;
  v1::RunStatus status;
  std::unique_ptr<grpc::ClientWriter<v1::LoadRequest>> load;
  std::unique_ptr<grpc::ClientReaderWriter<v1::FrameRequest, v1::Frame>> watch;
  std::unique_ptr<grpc::ClientReaderWriter<internal::Sealed, internal::Sealed>> work;
  std::unique_ptr<grpc::ClientReaderWriter<v1::DriveRequest, v1::DriveResponse>> drive;
  std::unique_ptr<grpc::GenericStub> generic_stub;
  std::unique_ptr<grpc::GenericClientAsyncReaderWriter> status_watch;
  std::vector<std::pair<const char*, std::function<grpc::Status()>>> finish;  ///< waits for the end of each call
};

TEST(FirstMessage, HasADeadlineOfTenSecondsInEveryStreamingMethod) {
  ManualClock clock;
  ServedWorld::Options options = paused();
  options.robots_elsewhere = true;
  options.server.now = [&clock] { return clock.read(); };
  ServedWorld world(options);
  SilentCalls calls(world.connectOptions());
  // The last call over the same connection is refused: once it has ended, the preceding ones have been received.
  grpc::ClientContext context;
  const auto last = calls.robots_stub->Drive(&context);
  last->Write({});
  EXPECT_EQ(last->Finish().error_code(), grpc::StatusCode::INVALID_ARGUMENT);

  clock.advance(10s - 1ns);
  clock.waitForReads();
  EXPECT_EQ(countOf("no first message", world.log()), 0u) << world.log();
  clock.advance(1ns);
  for (const auto& [kind, finish] : calls.finish) {
    const grpc::Status status = finish();
    EXPECT_EQ(status.error_code(), grpc::StatusCode::DEADLINE_EXCEEDED) << kind;
    EXPECT_EQ(status.error_message(), "no first message within 10000 ms of the call; send it at once, and call again")
        << kind;
  }
  EXPECT_EQ(countOf("no first message", world.log()), calls.finish.size()) << world.log();
}

TEST(FirstMessage, OfAWatcherIsItsOnlyOne) {
  ServedWorld world(paused());
  const auto status_after = [&](const std::vector<v1::WatchRequest>& requests) {
    grpc::TemplatedGenericStub<v1::WatchRequest, v1::RunStatus> stub(connect(world.connectOptions()));
    grpc::ClientContext context;
    grpc::CompletionQueue queue;
    const auto wait = [&] {
      void* tag = nullptr;
      bool ok = false;
      EXPECT_TRUE(queue.Next(&tag, &ok));
      return ok;  // false for an operation after the end of the call
    };
    const auto call = stub.PrepareCall(&context, "/robosim.v1.ControlPanel/Watch", &queue);
    call->StartCall(nullptr);
    wait();
    for (const auto& request : requests) {
      call->Write(request, nullptr);
      wait();
    }
    call->WritesDone(nullptr);
    wait();
    v1::RunStatus status;
    do {
      call->Read(&status, nullptr);  // gRPC delivers the end of the call after its messages
    } while (wait());
    grpc::Status end;
    call->Finish(&end, nullptr);
    wait();
    return end;
  };
  v1::WatchRequest request;
  request.set_protocol(kProtocolVersion);
  EXPECT_EQ(status_after({}).error_message(), "a call without a request; see doc/protocol.md");
  EXPECT_EQ(status_after({request, request}).error_message(), "a second request in one call");
}

TEST(RefusedCalls, AreLoggedForEveryKindOfCall) {
  ServedWorld::Options options = paused();
  options.server.access = Access::parse("master-0123456789ab operator\n", "tokens");
  ServedWorld world(options);
  SilentCalls calls(world.connectOptions());
  for (const auto& [kind, finish] : calls.finish) {
    EXPECT_EQ(finish().error_code(), grpc::StatusCode::UNAUTHENTICATED) << kind;
  }
  const std::string log = world.log();
  for (const char* who :
       {"control panel ipv4:127.0.0.1:", "viewer ipv4:127.0.0.1:", "geometry worker ipv4:127.0.0.1:"}) {
    EXPECT_GT(countOf(who, log), 0u) << who << "\n" << log;
  }
  EXPECT_EQ(countOf("requires a token", log), calls.finish.size()) << log;
}

}  // namespace
}  // namespace robosim
