#include "net/switchboard.h"

#include <atomic>
#include <future>

#include <gtest/gtest.h>

#include "net/dial.h"
#include "net/stream_call.h"
#include "net/viewing.grpc.pb.h"

namespace robosim {
namespace {

using Service = wire::Viewing::WithRawMethod_Watch<wire::Viewing::Service>;

/// Counts what its peer says.
class Listener final : public StreamCall<wire::FrameRequest, wire::Frame> {
 public:
  Listener(Switchboard& switchboard, Turn turn) : StreamCall(switchboard), turn_(turn) {}
  int heard = 0;

 private:
  void called() override {}
  Turn received(const wire::FrameRequest&) override {
    ++heard;
    return turn_;
  }
  void refuse(const WireError&) override {}
  void ended() override {}

  const Turn turn_;
};

class Talker {
 public:
  explicit Talker(int port)
      : stub_(wire::Viewing::NewStub(dial({.address = "127.0.0.1:" + std::to_string(port)}))),
        stream_(stub_->Watch(&context_)) {}
  ~Talker() {
    context_.TryCancel();
    stream_->Finish();
  }
  void say(int messages) {
    for (int i = 0; i < messages; ++i) {
      if (!stream_->Write({})) return;
    }
  }
  void giveUp() { context_.TryCancel(); }

 private:
  std::unique_ptr<wire::Viewing::Stub> stub_;
  grpc::ClientContext context_;
  std::unique_ptr<grpc::ClientReaderWriter<wire::FrameRequest, wire::Frame>> stream_;
};

TEST(Switchboard, HearsOneWhoSpeaksOnceBesideOneWhoSpeaksWithoutEnd) {
  Service service;
  Switchboard switchboard({{"127.0.0.1:0", &service}}, {});
  const auto line = switchboard.line(0);
  const auto listen = [&] {
    const auto listener = std::make_shared<Listener>(switchboard, Turn::in_measure);
    listener->await([&](auto* context, auto* wire, void* tag) {
      service.RequestWatch(context, wire, line.calls, line.arrivals, tag);
    });
    return listener;
  };
  const auto patience = std::chrono::minutes(1);
  const auto wait_until = [&](const std::function<bool()>& is_enough) {
    switchboard.waitUntil(Switchboard::Clock::now() + patience, is_enough);
    EXPECT_TRUE(is_enough());
  };
  // The one called first takes the listener that waited first.
  auto of_chatterer = listen();
  Talker chatterer(switchboard.port(0));
  auto chatter = std::async(std::launch::async, [&] { chatterer.say(1'000'000); });
  wait_until([&] { return of_chatterer->heard > 0; });
  auto of_other = listen();
  Talker other(switchboard.port(0));
  auto hello = std::async(std::launch::async, [&] { other.say(1); });
  wait_until([&] { return of_other->heard == 1; });
  hello.get();
  // Each time the same: what the chatterer has said by now lies here, and the other speaks after that.
  for (int i = 0; i < 10; ++i) {
    std::async(std::launch::async, [&] { other.say(1); }).get();
    const int heard_before = of_chatterer->heard;
    wait_until([&] { return of_other->heard == i + 2; });
    EXPECT_LT(of_chatterer->heard - heard_before, 100);
  }
  chatterer.giveUp();
  other.giveUp();
  of_chatterer.reset();
  of_other.reset();
  switchboard.close();
  chatter.get();
}

}  // namespace
}  // namespace robosim
