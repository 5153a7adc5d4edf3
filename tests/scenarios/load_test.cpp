// Worlds loaded by control panels: built while the run continues, one at a time, with limits of size and time.
#include <future>
#include <new>

#include <gtest/gtest.h>

#include "server/world_pieces.h"
#include "tests/scenarios/manual_clock.h"
#include "tests/scenarios/panel.h"
#include "tests/scenarios/program.h"
#include "tests/scenarios/wait.h"

namespace robosim {
namespace {

using namespace std::chrono_literals;

/// A Load call that sends one piece and then waits.
class HeldLoad {
 public:
  explicit HeldLoad(const ServedWorld& world)
      : stub_(v1::ControlPanel::NewStub(connect(world.connectOptions()))), stream_(stub_->Load(&context_, &status_)) {
    v1::LoadRequest piece;
    piece.set_protocol(kProtocolVersion);
    piece.set_piece("x");
    stream_->Write(piece);
  }
  grpc::Status howItEnds() { return stream_->Finish(); }

 private:
  std::unique_ptr<v1::ControlPanel::Stub> stub_;
  grpc::ClientContext context_;
  v1::RunStatus status_;
  std::unique_ptr<grpc::ClientWriter<v1::LoadRequest>> stream_;
};

/// A paused world in which the first load waits, before it is built, until it may proceed.
class SlowLoading {
 public:
  ServedWorld::Options options() {
    ServedWorld::Options options = paused();
    options.before_preparing = [this] {
      started_.set_value();
      may_proceed_.get_future().wait();
    };
    return options;
  }
  void waitUntilStarted() { started_.get_future().wait(); }
  void proceed() { may_proceed_.set_value(); }

 private:
  std::promise<void> started_, may_proceed_;
};

/// Status of a load that does not replace the world.
grpc::StatusCode codeOfBadLoad(const ServedWorld& world) {
  return howLoadEnds(world.connectOptions(), "no world", 100).error_code();
}

grpc::StatusCode codeOfLoad(const ServedWorld& world) {
  try {
    Panel(world).load("worlds/open_100.xml");
    return grpc::StatusCode::OK;
  } catch (const ConnectionError& error) {
    return error.code();
  }
}

TEST(Load, IsBuiltConcurrentlyAndRefusesASecondLoad) {
  SlowLoading loading;
  ServedWorld world(loading.options());
  Panel panel(world);
  auto load = std::async(std::launch::async, [&] { return codeOfLoad(world); });
  loading.waitUntilStarted();
  EXPECT_EQ(panel.step(25).step(), 25u);
  EXPECT_EQ(panel.status().world(), "small_maze");
  EXPECT_EQ(codeOfLoad(world), grpc::StatusCode::RESOURCE_EXHAUSTED);
  world.waitForLog("load: refused: the environment is loading a world for another call");
  loading.proceed();
  EXPECT_EQ(load.get(), grpc::StatusCode::OK);
  EXPECT_EQ(panel.status().world(), "open_100");
  EXPECT_EQ(panel.status().step(), 0u);
}

TEST(Load, IsRefusedAfterAnyExceptionAndTheRunContinues) {
  ServedWorld::Options options = paused();
  options.before_preparing = [] { throw std::bad_alloc(); };
  ServedWorld world(options);
  Panel panel(world);
  EXPECT_EQ(codeOfLoad(world), grpc::StatusCode::INTERNAL);
  world.waitForLog("the world cannot be loaded: std::bad_alloc; the present run continues");
  EXPECT_EQ(panel.step(3).step(), 3u);
  EXPECT_EQ(panel.status().world(), "small_maze");
}

TEST(Load, IsCancelledWhenItsPanelDisconnects) {
  SlowLoading loading;
  ServedWorld world(loading.options());
  Panel leaving(world);
  auto load =
      std::async(std::launch::async, [&] { EXPECT_THROW(leaving.load("worlds/open_100.xml"), ConnectionError); });
  loading.waitUntilStarted();
  leaving.leave();
  load.get();
  Panel panel(world);
  EXPECT_EQ(panel.step(3).step(), 3u);
  loading.proceed();
  waitUntil("the world of the panel that has left is no longer being loaded",
            [&] { return codeOfBadLoad(world) != grpc::StatusCode::RESOURCE_EXHAUSTED; });
  EXPECT_EQ(panel.status().world(), "small_maze");
  EXPECT_EQ(panel.status().step(), 3u);
}

TEST(Load, StalledLoadIsCancelledAfterAMinute) {
  ManualClock clock;
  ServedWorld::Options options = paused();
  options.server.now = [&clock] { return clock.read(); };
  ServedWorld world(options);
  HeldLoad held(world);
  waitUntil("the preceding load has been received",
            [&] { return codeOfBadLoad(world) == grpc::StatusCode::RESOURCE_EXHAUSTED; });
  clock.advance(60s);
  const grpc::Status status = held.howItEnds();
  EXPECT_EQ(status.error_code(), grpc::StatusCode::DEADLINE_EXCEEDED);
  EXPECT_EQ(codeOfLoad(world), grpc::StatusCode::OK);
}

TEST(Load, RejectsOversizedWorlds) {
  ServedWorld world(paused());
  const std::string too_many(WorldPieces::kBytesMax + 1, 'x');
  const grpc::Status status = howLoadEnds(world.connectOptions(), too_many, 4'000'000);
  EXPECT_EQ(status.error_code(), grpc::StatusCode::INVALID_ARGUMENT);
  EXPECT_NE(status.error_message().find("a world of more than 128 MiB"), std::string::npos) << status.error_message();
  EXPECT_EQ(Panel(world).step(1).step(), 1u);
}

}  // namespace
}  // namespace robosim
