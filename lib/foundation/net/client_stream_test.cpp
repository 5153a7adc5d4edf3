#include "net/client_stream.h"

#include <future>

#include <gtest/gtest.h>

#include "net/open_port.h"
#include "robosim/v1/viewing.grpc.pb.h"

namespace robosim {
namespace {

/// Sends each message back except 1000; ends the stream after the message 0, and with an error after the message 99.
class EchoService final : public v1::Viewing::Service {
  grpc::Status Watch(grpc::ServerContext*, grpc::ServerReaderWriter<v1::Frame, v1::FrameRequest>* stream) override {
    v1::FrameRequest request;
    while (stream->Read(&request)) {
      if (request.protocol() == 0) return grpc::Status::OK;
      if (request.protocol() == 99) return {grpc::StatusCode::INVALID_ARGUMENT, "99"};
      if (request.protocol() == 1000) continue;
      v1::Frame frame;
      frame.set_step(request.protocol());
      stream->Write(frame);
    }
    return grpc::Status::OK;
  }
};

struct ClientStreamTest : testing::Test {
  using Stream = ClientStream<v1::FrameRequest, v1::Frame>;

  EchoService service;
  OpenPort port = openPort("127.0.0.1:0", {.tls = {}, .option = "--listen"}, {&service});
  ConnectOptions options{.address = "127.0.0.1:" + std::to_string(port.number)};
  std::unique_ptr<v1::Viewing::Stub> stub = v1::Viewing::NewStub(connect(options));
  Stream stream{options, [this](auto... arguments) { return stub->AsyncWatch(arguments...); }};
  v1::Frame frame;

  static v1::FrameRequest request(std::uint32_t number) {
    v1::FrameRequest request;
    request.set_protocol(number);
    return request;
  }
  /// @return the echo; nullopt when the stream has ended
  std::optional<std::uint64_t> send(std::uint32_t number) {
    stream.write(request(number));
    if (!stream.read(frame)) return std::nullopt;
    return frame.step();
  }
  std::string errorOf(const std::function<void()>& call) const {
    try {
      call();
    } catch (const ConnectionError& error) {
      return error.what();
    }
    return "none";
  }
};

TEST_F(ClientStreamTest, CanBeOpenedAgainAfterItsEndAndDuringACall) {
  for (std::uint32_t i = 1; i < 4; ++i) {
    stream.open();
    EXPECT_EQ(send(i), i);
    EXPECT_EQ(send(0), std::nullopt);
    EXPECT_TRUE(stream.finish().ok());
    EXPECT_FALSE(stream.isOpen());
    stream.open();
    EXPECT_EQ(send(10 + i), 10 + i);
  }
}

TEST_F(ClientStreamTest, ReportsWhyItHasEnded) {
  stream.open();
  EXPECT_EQ(send(99), std::nullopt);
  EXPECT_EQ(errorOf([&] { stream.finishOrThrow(); }), "the environment at " + options.address + ": 99");
  stream.open();
  EXPECT_EQ(send(0), std::nullopt);
  EXPECT_EQ(errorOf([&] { stream.finishOrThrow(); }), "none");
  stream.open();
  EXPECT_EQ(send(0), std::nullopt);
  EXPECT_EQ(errorOf([&] { stream.fail(); }), "the environment at " + options.address + ": the run is over");
}

TEST_F(ClientStreamTest, EndsWhenTheClientHasWrittenAll) {
  stream.open();
  EXPECT_EQ(send(7), 7u);
  stream.writesDone();
  EXPECT_FALSE(stream.read(frame));
  EXPECT_TRUE(stream.finish().ok());
}

TEST_F(ClientStreamTest, RefusesToWriteAfterItsEnd) {
  stream.open();
  EXPECT_EQ(send(99), std::nullopt);
  while (stream.write(request(1))) {
  }
  EXPECT_EQ(stream.finish().error_message(), "99");
}

TEST_F(ClientStreamTest, SendsMessagesOfAnotherThreadWhileTheReaderWaits) {
  stream.setAdaptivePolling(false);
  stream.open();
  auto unanswered = std::async(std::launch::async, [&] { stream.write(request(1000)); });
  EXPECT_EQ(stream.next(frame), Stream::Event::written);
  EXPECT_FALSE(stream.isWriting());
  unanswered.get();
  const auto next_but_written = [&] {
    const auto event = stream.next(frame);
    return event == Stream::Event::written ? stream.next(frame) : event;
  };
  auto answered = std::async(std::launch::async, [&] { stream.write(request(1)); });
  EXPECT_EQ(next_but_written(), Stream::Event::received);
  EXPECT_EQ(frame.step(), 1u);
  answered.get();
  while (stream.isWriting()) EXPECT_EQ(stream.next(frame), Stream::Event::written);
  auto last = std::async(std::launch::async, [&] { stream.write(request(0)); });
  EXPECT_EQ(next_but_written(), Stream::Event::ended);
  last.get();
  EXPECT_TRUE(stream.finish().ok());
}

TEST_F(ClientStreamTest, CancelEndsAWaitAndAllLaterCalls) {
  stream.open();
  EXPECT_EQ(send(1), 1u);
  auto cancel = std::async(std::launch::async, [&] { stream.cancel(); });
  EXPECT_FALSE(stream.read(frame));
  EXPECT_EQ(stream.finish().error_code(), grpc::StatusCode::CANCELLED);
  cancel.get();
  stream.open();
  EXPECT_EQ(send(1), std::nullopt);
  EXPECT_EQ(stream.finish().error_code(), grpc::StatusCode::CANCELLED);
  EXPECT_TRUE(stream.isCancelled());
}

TEST_F(ClientStreamTest, SharesACancellationWithOtherCalls) {
  CallCancellation cancellation;
  {
    const ClientCall call(options, cancellation);
    cancellation.cancel();
  }
  Stream other(options, cancellation, [this](auto... arguments) { return stub->AsyncWatch(arguments...); });
  other.open();
  EXPECT_FALSE(other.read(frame));
  EXPECT_EQ(other.finish().error_code(), grpc::StatusCode::CANCELLED);
}

}  // namespace
}  // namespace robosim
