#include "net/completion_queue_server.h"

#include <atomic>
#include <future>

#include <gtest/gtest.h>

#include "net/connect.h"
#include "net/stream_call.h"
#include "net/viewing.grpc.pb.h"

namespace robosim {
namespace {

using Service = wire::Viewing::WithRawMethod_Watch<wire::Viewing::Service>;

/// Counts the messages of its peer.
class CountingStream final : public StreamCall<wire::FrameRequest, wire::Frame> {
 public:
  CountingStream(CompletionQueueServer& queue_server, ReadPolicy policy) : StreamCall(queue_server), policy_(policy) {}
  int received_count = 0;

 private:
  void called() override {}
  ReadPolicy received(const wire::FrameRequest&) override {
    ++received_count;
    return policy_;
  }
  void refuse(const WireError&) override {}
  void ended() override {}

  const ReadPolicy policy_;
};

class Client {
 public:
  explicit Client(int port)
      : stub_(wire::Viewing::NewStub(connect({.address = "127.0.0.1:" + std::to_string(port)}))),
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
  std::unique_ptr<wire::Viewing::Stub> stub_;
  grpc::ClientContext context_;
  std::unique_ptr<grpc::ClientReaderWriter<wire::FrameRequest, wire::Frame>> stream_;
};

TEST(CompletionQueueServer, ServesOtherClientsDuringAFloodOfMessages) {
  Service service;
  CompletionQueueServer queue_server({{"127.0.0.1:0", &service}}, {});
  const auto queues = queue_server.queuesFor(0);
  const auto request_stream = [&] {
    const auto stream = std::make_shared<CountingStream>(queue_server, ReadPolicy::rate_limited);
    stream->await([&](auto* context, auto* wire, void* tag) {
      service.RequestWatch(context, wire, queues.call_queue, queues.notification_queue, tag);
    });
    return stream;
  };
  const auto timeout = std::chrono::minutes(1);
  const auto wait_until = [&](const std::function<bool()>& is_enough) {
    queue_server.waitUntil(CompletionQueueServer::Clock::now() + timeout, is_enough);
    EXPECT_TRUE(is_enough());
  };
  // Calls are assigned to requested streams in order.
  auto flooding_stream = request_stream();
  Client flooding_client(queue_server.port(0));
  auto flood = std::async(std::launch::async, [&] { flooding_client.send(1'000'000); });
  wait_until([&] { return flooding_stream->received_count > 0; });
  auto other_stream = request_stream();
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
  flooding_stream.reset();
  other_stream.reset();
  queue_server.close();
  flood.get();
}

}  // namespace
}  // namespace robosim
