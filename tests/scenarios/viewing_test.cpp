// Viewers, which may come, look, dawdle and go as they like.
#include <gtest/gtest.h>

#include "net/control_panel.grpc.pb.h"
#include "net/viewing.grpc.pb.h"
#include "net/wire_error.h"
#include "server/viewer.h"
#include "tests/scenarios/panel.h"
#include "tests/scenarios/program.h"
#include "tests/scenarios/served_world.h"

namespace robosim {
namespace {

ServedWorld::Options paused() {
  ServedWorld::Options options;
  options.server.is_paused = true;
  return options;
}

/// A viewer that shows what comes over the wire.
class RawViewer {
 public:
  explicit RawViewer(const DialOptions& options)
      : stub_(wire::Viewing::NewStub(dial(options))), stream_(stub_->Watch(&context_)) {}
  ~RawViewer() {
    context_.TryCancel();
    stream_->Finish();
  }
  RawViewer(const RawViewer&) = delete;
  RawViewer& operator=(const RawViewer&) = delete;

  void ask() {
    wire::FrameRequest request;
    request.set_protocol(kProtocolVersion);
    stream_->Write(request);
  }
  wire::Frame read() {
    wire::Frame frame;
    EXPECT_TRUE(stream_->Read(&frame));
    return frame;
  }
  wire::Frame next() {
    ask();
    return read();
  }

 private:
  grpc::ClientContext context_;
  std::unique_ptr<wire::Viewing::Stub> stub_;
  std::unique_ptr<grpc::ClientReaderWriter<wire::FrameRequest, wire::Frame>> stream_;
};

TEST(Viewing, ShowsTheWholeStateOnceAndThenWhatHasChanged) {
  ServedWorld::Options options = paused();
  options.controller = "still";
  ServedWorld world(options);
  RawViewer viewer(world.dialOptions());
  const wire::Frame first = viewer.next();
  EXPECT_TRUE(first.has_world());
  EXPECT_EQ(first.step(), 0u);
  EXPECT_EQ(first.robots_size(), 2);
  Panel(world).step(3);
  const wire::Frame second = viewer.next();
  EXPECT_FALSE(second.has_world());
  EXPECT_EQ(second.step(), 3u);
  EXPECT_EQ(second.robots_size(), 0) << "nobody has moved";
}

TEST(Viewing, ShowsWhereTheRobotsAre) {
  ServedWorld world(paused());
  Viewer viewer(world.dialOptions());
  Panel(world).step(40);
  ASSERT_TRUE(viewer.look());
  const Sight sight = viewer.sight();
  EXPECT_EQ(sight.step, 40u);
  EXPECT_DOUBLE_EQ(sight.time_s, 4.0);
  Viewer latecomer(world.dialOptions());
  EXPECT_EQ(latecomer.sight().robots, sight.robots) << "from changes, and as a whole";
  world.end();
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(sight.robots[i].world_from_robot, world.state().world_from_robot[i]);
    EXPECT_EQ(sight.robots[i].stalled, world.state().stalled[i] != 0);
  }
}

TEST(Viewing, SendsASlowViewerTheNewestStepAndNotThoseThatItMissed) {
  ServedWorld world(paused());
  RawViewer slow(world.dialOptions());
  slow.next();
  Panel panel(world);
  for (int i = 0; i < 5; ++i) panel.step(100);
  EXPECT_EQ(slow.next().step(), 500u);
}

TEST(Viewing, DelaysNobodyForAViewerThatNeverReads) {
  ServedWorld::Options options = paused();
  options.world = "worlds/open_100.xml";
  ServedWorld world(options);
  RawViewer deaf(world.dialOptions());
  for (int i = 0; i < 10000; ++i) deaf.ask();
  Viewer viewer(world.dialOptions());
  Panel panel(world);
  for (int i = 1; i <= 10; ++i) {
    panel.step(20);
    ASSERT_TRUE(viewer.look());
    EXPECT_EQ(viewer.sight().step, 20u * static_cast<unsigned>(i));
  }
  EXPECT_EQ(deaf.read().step(), 0u);
  // What it asked for, and left lying, was new then. With what it asks for now it is up to date.
  deaf.ask();
  while (deaf.read().step() != 200u) {
  }
}

TEST(Viewing, LetsViewersComeAndGoWithoutATraceInTheRun) {
  const auto digest = [](bool is_watched) {
    ServedWorld::Options options;
    options.last_step = 3000;
    options.server.is_paused = true;
    ServedWorld world(options);
    Viewer first(world.dialOptions());
    Panel(world).start();
    for (int i = 0; is_watched && i < 20; ++i) {
      try {
        Viewer viewer(world.dialOptions());
        if (!viewer.look()) break;
      } catch (const ConnectionError&) {
        break;  // the run is over
      }
    }
    world.wait();
    return world.digest();
  };
  EXPECT_EQ(digest(true), digest(false));
}

TEST(Viewing, ShowsEveryoneTheOtherWorldThatAPanelLoads) {
  ServedWorld world(paused());
  Viewer viewer(world.dialOptions());
  EXPECT_EQ(viewer.sight().world.world.name, "small_maze");
  Panel(world).load("worlds/open_100.xml");
  ASSERT_TRUE(viewer.look());
  EXPECT_TRUE(viewer.isOtherWorld());
  EXPECT_EQ(viewer.sight().world.world.name, "open_100");
  EXPECT_EQ(viewer.sight().robots.size(), 100u);
}

TEST(Viewing, TellsTheTextViewerEachFrameUntilTheRunIsOver) {
  ServedWorld world(paused());
  StartedProgram viewer(ROBOSIM_TEXT_VIEWER, {std::to_string(world.port())});
  viewer.waitForOutput("step 0; Pioneer1 ");
  Panel(world).step(7);
  viewer.waitForOutput("step 7; Pioneer1 ");
  world.end();
  EXPECT_EQ(viewer.wait().exit_code, 0);
}

}  // namespace
}  // namespace robosim
