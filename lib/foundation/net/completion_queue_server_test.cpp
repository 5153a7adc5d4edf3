#include "net/completion_queue_server.h"

#include <atomic>
#include <future>
#include <optional>
#include <thread>

#include <gtest/gtest.h>

#include "net/connect.h"
#include "net/stream_session.h"
#include "robosim/v1/viewing.grpc.pb.h"

namespace robosim {
namespace {

using Service = v1::Viewing::WithRawMethod_Watch<v1::Viewing::Service>;

/// Counts the messages of its peer.
class CountingStream final : public StreamSession<v1::FrameRequest, v1::Frame> {
 public:
  CountingStream(SessionHost& host, ReadPolicy policy)
      : StreamSession(host, {.right = Right::look, .log_kind = "refused"}), policy_(policy) {}
  int received_count = 0;

 private:
  std::string logName() const override { return peer(); }
  ReadPolicy received(const v1::FrameRequest&) override {
    if (!isEstablished()) establish();
    ++received_count;
    return policy_;
  }

  const ReadPolicy policy_;
};

class Client {
 public:
  explicit Client(int port)
      : stub_(v1::Viewing::NewStub(
            connect({.address = "127.0.0.1:" + std::to_string(port), .shares_connections = false}))),
        stream_(stub_->Watch(&context_)) {}
  ~Client() {
    context_.TryCancel();
    stream_->Finish();
  }
  void send(int messages) {
    for (int i = 0; i < messages; ++i) {
      if (!stream_->Write({})) return;
    }
  }
  void cancel() { context_.TryCancel(); }

 private:
  std::unique_ptr<v1::Viewing::Stub> stub_;
  grpc::ClientContext context_;
  std::unique_ptr<grpc::ClientReaderWriter<v1::FrameRequest, v1::Frame>> stream_;
};

TEST(CompletionQueueServer, IsWokenByOtherThreadsAnyNumberOfTimes) {
  Service service;
  CompletionQueueServer queue_server({{"127.0.0.1:0", &service}}, {});
  const auto timeout = std::chrono::minutes(5);
  for (int i = 0; i < 100; ++i) {
    std::atomic<bool> is_done{false};
    std::thread other([&] {
      is_done = true;
      for (int k = 0; k <= i % 3; ++k) queue_server.wake();
    });
    queue_server.waitUntil(CompletionQueueServer::Clock::now() + timeout, [&] { return is_done.load(); });
    EXPECT_TRUE(is_done);
    other.join();
  }
  queue_server.close();
  queue_server.wake();
}

TEST(CompletionQueueServer, ServesOtherClientsDuringAFloodOfMessages) {
  Service service;
  CompletionQueueServer queue_server({{"127.0.0.1:0", &service}}, {});
  SessionHost host;
  host.queue_server = &queue_server;
  std::vector<std::shared_ptr<CountingStream>> streams;  // the last one has no client yet
  const auto make_stream = [&] {
    streams.push_back(std::make_shared<CountingStream>(host, ReadPolicy::rate_limited));
    return streams.back();
  };
  host.serve(queue_server.queuesFor(0), make_stream, [&](auto... arguments) { service.RequestWatch(arguments...); });
  const auto timeout = std::chrono::minutes(1);
  const auto wait_until = [&](const std::function<bool()>& is_enough) {
    queue_server.waitUntil(CompletionQueueServer::Clock::now() + timeout, is_enough);
    EXPECT_TRUE(is_enough());
  };
  // Calls are assigned to requested streams in order.
  const auto* flooding_stream = streams.back().get();
  Client flooding_client(queue_server.port(0));
  auto first_of_flood = std::async(std::launch::async, [&] { flooding_client.send(1); });
  wait_until([&] { return flooding_stream->received_count == 1; });  // else its connection counts as unauthorised
  first_of_flood.get();
  auto flood = std::async(std::launch::async, [&] { flooding_client.send(1'000'000); });
  wait_until([&] { return flooding_stream->received_count > 1; });
  const auto* other_stream = streams.back().get();
  Client other_client(queue_server.port(0));
  auto first_message = std::async(std::launch::async, [&] { other_client.send(1); });
  wait_until([&] { return other_stream->received_count == 1; });
  first_message.get();
  // In each iteration, the flooding client's messages are already queued when the other client sends its own.
  for (int i = 0; i < 10; ++i) {
    std::async(std::launch::async, [&] { other_client.send(1); }).get();
    const int count_before = flooding_stream->received_count;
    wait_until([&] { return other_stream->received_count == i + 2; });
    EXPECT_LT(flooding_stream->received_count - count_before, 100);
  }
  flooding_client.cancel();
  other_client.cancel();
  streams.clear();
  queue_server.close();
  flood.get();
}

TEST(CompletionQueueServer, ClosesWithoutACallThatNeverEnds) {
  Service service;
  std::optional<CompletionQueueServer::CallRegistration> call;
  {
    CompletionQueueServer queue_server({{"127.0.0.1:0", &service}}, {});
    call.emplace(queue_server);
    queue_server.close(std::chrono::milliseconds(50));
  }
  call.reset();  // after the server
}

}  // namespace
}  // namespace robosim
