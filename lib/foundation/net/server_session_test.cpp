// Admission, deadline, refusal and shutdown of sessions, over real connections.
#include "net/server_session.h"

#include <condition_variable>
#include <mutex>
#include <thread>
#include <variant>

#include <gtest/gtest.h>

#include "net/connect.h"
#include "net/stream_session.h"
#include "net/unary_session.h"
#include "robosim/v1/control_panel.grpc.pb.h"
#include "robosim/v1/viewing.grpc.pb.h"

namespace robosim {
namespace {

using namespace std::chrono_literals;

const std::string kViewerToken = "viewer-0123456789abcdef", kWorkerToken = "worker-0123456789abcdef";

/// A value for which the handlers below have a fault.
constexpr std::uint32_t kFaultyProtocol = 666;

using EchoStreamService = v1::Viewing::WithRawMethod_Watch<v1::Viewing::Service>;
using EchoUnaryService = v1::ControlPanel::WithAsyncMethod_Step<v1::ControlPanel::Service>;

/// A server that sends each message back, on a thread of its own, with a clock that only the test advances.
class EchoServer {
 public:
  explicit EchoServer(bool has_tokens = true) {
    host_.log = [this](const std::string& line) { log_ += line + "\n"; };
    host_.now = [this] { return now_; };
    host_.queue_server = &queue_server_;
    Access::Options options;
    constexpr std::chrono::sys_days kStart(std::chrono::year(2029) / 6 / 1);
    options.now = [this, kStart] { return kStart + now_.time_since_epoch(); };
    if (has_tokens) {
      host_.access = Access::parse(kViewerToken + " viewer expires=2030-01-01\n" + kWorkerToken + " geometry\n",
                                   "tokens", options);
    }
    queue_server_.setMutex(&mutex_);
    host_.serve(
        queue_server_.queuesFor(0), [this] { return std::make_shared<EchoStream>(*this); },
        [this](auto... arguments) { streams_.RequestWatch(arguments...); });
    host_.serve(
        queue_server_.queuesFor(0), [this] { return std::make_shared<Doubling>(*this); },
        [this](auto... arguments) { unary_.RequestStep(arguments...); });
    thread_ = std::thread([this] {
      queue_server_.waitUntil(CompletionQueueServer::Clock::now() + std::chrono::hours(1), [this] {
        const std::lock_guard lock(mutex_);
        return is_closing_;
      });
      queue_server_.close();
    });
  }
  ~EchoServer() {
    {
      const std::lock_guard lock(mutex_);
      host_.endSessions();
      is_closing_ = true;
      queue_server_.wake();
    }
    thread_.join();
  }

  /// Calls `change` between two events.
  template <typename Change>
  void change(const Change& change) {
    const std::lock_guard lock(mutex_);
    change(host_);
  }
  void advance(SessionHost::Clock::duration by) {
    const std::lock_guard lock(mutex_);
    now_ += by;
    host_.checkSessions();
  }
  /// Waits until a number of calls have been admitted, or left.
  void waitForAdmitted(int count) { wait(admitted_, count); }
  void waitForLeft(int count) { wait(left_, count); }
  std::string log() {
    const std::lock_guard lock(mutex_);
    return log_;
  }
  ConnectOptions connectOptions(const std::string& token) const {
    return {.address = "127.0.0.1:" + std::to_string(queue_server_.port(0)), .token = token};
  }

 private:
  class EchoStream final : public StreamSession<v1::FrameRequest, v1::Frame> {
   public:
    explicit EchoStream(EchoServer& owner)
        : StreamSession(owner.host_, {.right = Right::look, .log_kind = "refused clients", .reports_each = true}),
          owner_(owner) {}

   private:
    std::string logName() const override { return "client"; }
    grpc::Status admit() override {
      owner_.count(owner_.admitted_);
      return grpc::Status::OK;
    }
    ReadPolicy received(const v1::FrameRequest& message) override {
      if (message.protocol() == 0) throw WireError("protocol 0");
      if (message.protocol() == kFaultyProtocol) throw std::bad_variant_access();
      if (!isEstablished()) establish();
      draft().set_step(message.protocol());
      post();
      return ReadPolicy::immediate;
    }
    void left() override { owner_.count(owner_.left_); }

    EchoServer& owner_;
  };

  class Doubling final : public UnarySession<v1::StepRequest, v1::RunStatus> {
   public:
    explicit Doubling(EchoServer& owner)
        : UnarySession(owner.host_, {.right = Right::look, .log_kind = "refused clients"}) {}

   private:
    std::string logName() const override { return "unary client"; }
    void received(const v1::StepRequest& request) override {
      if (request.steps() == 0) throw WireError("0 steps");
      if (request.steps() == kFaultyProtocol) throw std::bad_variant_access();
      establish();
      v1::RunStatus reply;
      reply.set_step(2 * request.steps());
      answer(reply);
      answer({});  // has no effect
    }
  };

  void count(int& number) {
    ++number;
    counted_.notify_all();
  }
  void wait(const int& number, int expected) {
    std::unique_lock lock(mutex_);
    if (!counted_.wait_for(lock, 1min, [&] { return number >= expected; }))
      throw std::runtime_error("waited for " + std::to_string(expected) + ", and there are " + std::to_string(number));
  }

  std::mutex mutex_;
  std::condition_variable counted_;
  std::string log_;
  SessionHost::Clock::time_point now_{};
  int admitted_ = 0, left_ = 0;
  bool is_closing_ = false;
  EchoStreamService streams_;
  EchoUnaryService unary_;
  SessionHost host_;
  CompletionQueueServer queue_server_{{{"127.0.0.1:0", &streams_}, {"127.0.0.1:0", &unary_}}, {}};
  std::thread thread_;
};

class EchoClient {
 public:
  explicit EchoClient(const ConnectOptions& options) : stub_(v1::Viewing::NewStub(connect(options))) {
    attachToken(context_, options);
    stream_ = stub_->Watch(&context_);
  }
  ~EchoClient() {
    if (!stream_) return;
    context_.TryCancel();
    stream_->Finish();
  }

  /// Sends a number. @return the server's echo; nullopt when the call has ended
  std::optional<std::uint64_t> send(std::uint32_t number) {
    v1::FrameRequest request;
    request.set_protocol(number);
    v1::Frame frame;
    if (!stream_->Write(request) || !stream_->Read(&frame)) return std::nullopt;
    return frame.step();
  }
  /// Waits for the end of the call.
  grpc::Status finish() {
    v1::Frame frame;
    while (stream_->Read(&frame)) {
    }
    const grpc::Status status = stream_->Finish();
    stream_.reset();
    return status;
  }
  void leave() {
    stream_->WritesDone();
    EXPECT_TRUE(finish().ok());
  }

 private:
  std::unique_ptr<v1::Viewing::Stub> stub_;
  grpc::ClientContext context_;
  std::unique_ptr<grpc::ClientReaderWriter<v1::FrameRequest, v1::Frame>> stream_;
};

std::size_t occurrencesOf(const std::string& part, const std::string& text) {
  std::size_t count = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

TEST(ServerSession, AdmitsClientsWhoseTokenGrantsTheRight) {
  EchoServer server;
  EchoClient viewer(server.connectOptions(kViewerToken));
  EXPECT_EQ(viewer.send(7), 7u);
  EXPECT_EQ(EchoClient(server.connectOptions("")).finish().error_code(), grpc::StatusCode::UNAUTHENTICATED);
  EXPECT_EQ(EchoClient(server.connectOptions(kWorkerToken)).finish().error_code(), grpc::StatusCode::PERMISSION_DENIED);
  EXPECT_EQ(viewer.send(8), 8u);
  EXPECT_EQ(occurrencesOf("client: disconnected: ", server.log()), 2u) << server.log();
}

TEST(ServerSession, ReportsAnInvalidMessageToItsSenderAndToTheLog) {
  EchoServer server;
  EchoClient client(server.connectOptions(kViewerToken));
  EXPECT_EQ(client.send(7), 7u);
  EXPECT_EQ(client.send(0), std::nullopt);
  const grpc::Status status = client.finish();
  EXPECT_EQ(status.error_code(), grpc::StatusCode::INVALID_ARGUMENT);
  EXPECT_EQ(status.error_message(), "protocol 0");
  EXPECT_EQ(server.log(), "client: disconnected: protocol 0\n");
}

TEST(ServerSession, EndsOnlyTheCallWhoseHandlerThrows) {
  EchoServer server;
  EchoClient other(server.connectOptions(kViewerToken)), client(server.connectOptions(kViewerToken));
  EXPECT_EQ(other.send(7), 7u);
  EXPECT_EQ(client.send(7), 7u);
  EXPECT_EQ(client.send(kFaultyProtocol), std::nullopt);
  const grpc::Status status = client.finish();
  EXPECT_EQ(status.error_code(), grpc::StatusCode::INTERNAL);
  EXPECT_EQ(status.error_message(),
            "an internal error of the server has ended this call; the server's log states the cause");
  server.waitForLeft(1);
  EXPECT_EQ(server.log().find("client: internal error: "), 0u) << server.log();
  EXPECT_EQ(other.send(8), 8u);
}  // the server closes: no operation is left open

TEST(ServerSession, EndsACallWhoseFirstMessageIsOverdue) {
  EchoServer server;
  EchoClient silent(server.connectOptions(kViewerToken));
  server.waitForAdmitted(1);
  EchoClient speaking(server.connectOptions(kViewerToken));
  EXPECT_EQ(speaking.send(7), 7u);
  server.change([](SessionHost& host) { EXPECT_EQ(host.nextDeadline(), host.now() + 10s); });
  server.advance(10s - 1ns);
  EXPECT_EQ(server.log(), "");
  server.advance(1ns);
  const grpc::Status status = silent.finish();
  EXPECT_EQ(status.error_code(), grpc::StatusCode::DEADLINE_EXCEEDED);
  EXPECT_EQ(status.error_message(), "no first message within 10000 ms of the call; send it at once, and call again");
  EXPECT_EQ(speaking.send(8), 8u);
  server.change([](SessionHost& host) { EXPECT_EQ(host.nextDeadline(), SessionHost::Clock::time_point::max()); });
}

TEST(ServerSession, ChecksTheTokenAgainAtTheFirstMessage) {
  EchoServer server;
  EchoClient client(server.connectOptions(kViewerToken));
  server.waitForAdmitted(1);
  server.change([](SessionHost& host) { host.access = Access::parse(kWorkerToken + " geometry\n", "tokens"); });
  EXPECT_EQ(client.send(7), std::nullopt);
  EXPECT_EQ(client.finish().error_code(), grpc::StatusCode::UNAUTHENTICATED);
}

TEST(ServerSession, DisconnectsAClientWhenItsTokenExpires) {
  EchoServer server;
  EchoClient client(server.connectOptions(kViewerToken));
  EXPECT_EQ(client.send(7), 7u);
  server.advance(2s);
  EXPECT_EQ(client.send(8), 8u);
  server.advance(24h * 366);
  const grpc::Status status = client.finish();
  EXPECT_EQ(status.error_code(), grpc::StatusCode::UNAUTHENTICATED);
  EXPECT_NE(status.error_message().find("has expired"), std::string::npos) << status.error_message();
  server.waitForLeft(1);
}

TEST(ServerSession, LimitsTheRateAtWhichRefusalsAreLogged) {
  EchoServer server;
  for (int i = 0; i < 15; ++i) EchoClient(server.connectOptions("")).finish();
  EXPECT_EQ(occurrencesOf("client: disconnected: ", server.log()), 10u);
  server.advance(2s);
  EXPECT_NE(server.log().find("refused clients: 5 more lines"), std::string::npos) << server.log();
}

TEST(ServerSession, ReportsAClientThatLeavesOnce) {
  EchoServer server;
  EchoClient client(server.connectOptions(kViewerToken));
  EXPECT_EQ(client.send(7), 7u);
  client.leave();
  server.waitForLeft(1);
  {
    EchoClient cancelling(server.connectOptions(kViewerToken));
    EXPECT_EQ(cancelling.send(7), 7u);
  }
  server.waitForLeft(2);
  EXPECT_EQ(server.log(), "client: has left\nclient: has left\n");
}

TEST(ServerSession, EndsAllCallsWithTheRunAndRefusesLaterOnes) {
  EchoServer server(false);
  EchoClient established(server.connectOptions("")), silent(server.connectOptions(""));
  EXPECT_EQ(established.send(7), 7u);
  server.waitForAdmitted(2);
  server.change([](SessionHost& host) { host.endSessions(); });
  EXPECT_TRUE(established.finish().ok());
  EXPECT_EQ(silent.finish().error_message(), "the run is over");
  const grpc::Status late = EchoClient(server.connectOptions("")).finish();
  EXPECT_EQ(late.error_code(), grpc::StatusCode::UNAVAILABLE);
  EXPECT_EQ(late.error_message(), "the run is over");
  server.waitForLeft(1);
}

TEST(UnarySession, AnswersOrRefusesLikeAStream) {
  EchoServer server;
  const auto call = [&](const std::string& token, std::uint64_t steps, v1::RunStatus& reply) {
    const ConnectOptions options = server.connectOptions(token);
    const auto stub = v1::ControlPanel::NewStub(connect(options));
    grpc::ClientContext context;
    attachToken(context, options);
    v1::StepRequest request;
    request.set_steps(steps);
    return stub->Step(&context, request, &reply);
  };
  v1::RunStatus reply;
  EXPECT_TRUE(call(kViewerToken, 4, reply).ok());
  EXPECT_EQ(reply.step(), 8u);
  EXPECT_EQ(call(kViewerToken, 0, reply).error_message(), "0 steps");
  EXPECT_EQ(call("", 4, reply).error_code(), grpc::StatusCode::UNAUTHENTICATED);
  EXPECT_EQ(occurrencesOf("unary client: disconnected: ", server.log()), 2u) << server.log();
  EXPECT_EQ(call(kViewerToken, kFaultyProtocol, reply).error_code(), grpc::StatusCode::INTERNAL);
  EXPECT_EQ(occurrencesOf("unary client: internal error: ", server.log()), 1u) << server.log();
  EXPECT_TRUE(call(kViewerToken, 4, reply).ok());
}

}  // namespace
}  // namespace robosim
