// Viewers that connect, read slowly or not at all, and disconnect.
#include <algorithm>
#include <future>
#include <utility>

#include <gtest/gtest.h>

#include "client/viewer.h"
#include "net/wire_error.h"
#include "robosim/v1/viewing.grpc.pb.h"
#include "tests/scenarios/panel.h"
#include "tests/scenarios/program.h"
#include "tests/scenarios/served_world.h"
#include "tests/scenarios/wait.h"

namespace robosim {
namespace {

/// A viewer that exposes the received messages.
class RawViewer {
 public:
  explicit RawViewer(const ConnectOptions& options)
      : stub_(v1::Viewing::NewStub(connect(options))), stream_(stub_->Watch(&context_)) {}
  ~RawViewer() {
    context_.TryCancel();
    if (stream_) stream_->Finish();
  }
  RawViewer(const RawViewer&) = delete;
  RawViewer& operator=(const RawViewer&) = delete;

  void ask(const ReadingsSelection& wish = {}, bool amends = false) {
    v1::FrameRequest request;
    request.set_protocol(kProtocolVersion);
    encode(wish, request);
    request.set_amends(amends);
    stream_->Write(request);
  }
  void sendInvalid() {
    v1::FrameRequest request;
    v1::FrameRequest::GetReflection()->MutableUnknownFields(&request)->AddLengthDelimited(3, "\xff");
    stream_->Write(request);
  }
  void sayNothingMore() { stream_->WritesDone(); }
  grpc::Status howItEnds() {
    for (v1::Frame frame; stream_->Read(&frame);) {
    }
    return std::exchange(stream_, nullptr)->Finish();
  }
  v1::Frame read() {
    v1::Frame frame;
    EXPECT_TRUE(stream_->Read(&frame));
    return frame;
  }
  v1::Frame next() {
    ask();
    return read();
  }

 private:
  grpc::ClientContext context_;
  std::unique_ptr<v1::Viewing::Stub> stub_;
  std::unique_ptr<grpc::ClientReaderWriter<v1::FrameRequest, v1::Frame>> stream_;
};

TEST(Viewing, SendsTheFullStateOnceAndThenChanges) {
  ServedWorld::Options options = paused();
  options.controller = "still";
  ServedWorld world(options);
  RawViewer viewer(world.connectOptions());
  const v1::Frame first = viewer.next();
  EXPECT_TRUE(first.has_world());
  EXPECT_EQ(first.step(), 0u);
  EXPECT_EQ(first.robots_size(), 2);
  Panel(world).step(3);
  const v1::Frame second = viewer.next();
  EXPECT_FALSE(second.has_world());
  EXPECT_EQ(second.step(), 3u);
  EXPECT_EQ(second.robots_size(), 0) << "no robot has moved";
}

TEST(Viewing, SendsRobotPoses) {
  ServedWorld world(paused());
  Viewer viewer(world.connectOptions());
  Panel(world).step(40);
  ASSERT_TRUE(viewer.waitForFrame());
  const ViewedRun viewed_run = viewer.run();
  EXPECT_EQ(viewed_run.snapshot.step, 40u);
  EXPECT_DOUBLE_EQ(viewed_run.snapshot.time_s, 4.0);
  Viewer latecomer(world.connectOptions());
  EXPECT_EQ(latecomer.run().snapshot.robots, viewed_run.snapshot.robots) << "from changes, and as a whole";
  world.end();
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(viewed_run.snapshot.robots[i].world_from_robot, world.state().world_from_robot[i]);
    EXPECT_EQ(viewed_run.snapshot.robots[i].stalled, world.state().stalled[i] != 0);
  }
}

TEST(Viewing, SendsASlowViewerOnlyTheLatestStep) {
  ServedWorld world(paused());
  RawViewer slow(world.connectOptions());
  slow.next();
  Panel panel(world);
  for (int i = 0; i < 5; ++i) panel.step(100);
  EXPECT_EQ(slow.next().step(), 500u);
}

TEST(Viewing, IsNotDelayedByAViewerThatNeverReads) {
  ServedWorld::Options options = paused();
  options.world = "worlds/open_100.xml";
  ServedWorld world(options);
  RawViewer deaf(world.connectOptions());
  for (int i = 0; i < 1000; ++i) deaf.ask();
  Viewer viewer(world.connectOptions());
  Panel panel(world);
  for (int i = 1; i <= 10; ++i) {
    panel.step(20);
    ASSERT_TRUE(viewer.waitForFrame());
    EXPECT_EQ(viewer.run().snapshot.step, 20u * static_cast<unsigned>(i));
  }
  EXPECT_EQ(deaf.read().step(), 0u);
  // The reply to its first request, which it did not read, is outdated. The reply to its next request is current.
  deaf.ask();
  while (deaf.read().step() != 200u) {
  }
}

void expectReadings(const ViewedRun& viewed_run, const ServedWorld& world, const std::vector<std::size_t>& of) {
  for (std::size_t i = 0; i < viewed_run.snapshot.robots.size(); ++i) {
    const Readings* readings = viewed_run.readingsOf(i);
    ASSERT_EQ(readings != nullptr, std::find(of.begin(), of.end(), i) != of.end()) << i;
    if (!readings) continue;
    EXPECT_EQ(readings->measurements, world.state().readings[i].measurements) << i;
  }
}

TEST(Viewing, DisconnectsAViewerThatSendsInvalidInputWithoutReading) {
  ServedWorld::Options options = paused();
  options.world = "worlds/open_100.xml";
  ServedWorld world(options);
  RawViewer deaf(world.connectOptions());
  Panel panel(world);
  for (int i = 1; i <= 200; ++i) {  // far more than fits into the buffers
    deaf.ask({.of_all = true, .of = {}});
    panel.step(1);
  }
  EXPECT_EQ(panel.status().viewers(), 1u);
  deaf.sendInvalid();
  waitUntil("the viewer is disconnected", [&] { return panel.status().viewers() == 0; });
  world.waitForLog("disconnected: a message that is not a valid robosim.v1.FrameRequest");
}

TEST(Viewing, AnswersASingleRequestBeforeHalfClose) {
  ServedWorld world(paused());
  RawViewer viewer(world.connectOptions());
  viewer.ask();
  viewer.sayNothingMore();
  EXPECT_EQ(viewer.read().robots_size(), 2);
  EXPECT_TRUE(viewer.howItEnds().ok());
}

TEST(Viewing, SendsOnlyRequestedReadings) {
  ServedWorld world(paused());
  Viewer viewer(world.connectOptions(), {.of_all = true, .of = {}});
  expectReadings(viewer.run(), world, {0, 1});
  viewer.select({.of_all = false, .of = {1}});
  Panel(world).step(5);
  ASSERT_TRUE(viewer.waitForFrame());
  EXPECT_EQ(viewer.run().snapshot.step, 5u);
  expectReadings(viewer.run(), world, {1});
  viewer.select({});
  ASSERT_TRUE(viewer.waitForFrame()) << "other readings are requested, so the step is sent again";
  EXPECT_EQ(viewer.run().snapshot.step, 5u);
  expectReadings(viewer.run(), world, {});
}

TEST(Viewing, ResendsAPausedStepWhenTheRequestedReadingsChange) {
  ServedWorld world(paused());
  RawViewer viewer(world.connectOptions());
  viewer.next();
  viewer.ask();  // nothing has changed, so there is no reply yet
  viewer.ask({.of_all = false, .of = {0}}, true);
  const v1::Frame frame = viewer.read();
  EXPECT_EQ(frame.step(), 0u);
  ASSERT_EQ(frame.readings_size(), 1);
  EXPECT_EQ(frame.readings(0).world_robot(), 0u);
  viewer.ask({.of_all = true, .of = {}}, true);  // does not request a frame
  Panel(world).step(1);
  viewer.ask({.of_all = true, .of = {}});
  EXPECT_EQ(viewer.read().step(), 1u) << "one frame for each request";
}

TEST(Viewing, CancelsAPendingRequestOnDisconnect) {
  ServedWorld world(paused());
  Viewer viewer(world.connectOptions());
  auto look = std::async(std::launch::async, [&] { return viewer.waitForFrame(); });
  viewer.leave();
  EXPECT_FALSE(look.get());
  EXPECT_FALSE(viewer.waitForFrame());
}

TEST(Viewing, ReportsWhetherATokenPermitsControl) {
  ServedWorld::Options options = paused();
  options.server.access = Access::parse("viewer-0123456789ab viewer\nmaster-0123456789ab operator\n", "tokens");
  ServedWorld world(options);
  const auto may_operate = [&](const std::string& token) {
    ConnectOptions connect_options = world.connectOptions();
    connect_options.token = token;
    return Viewer(connect_options).run().may_operate;
  };
  EXPECT_FALSE(may_operate("viewer-0123456789ab"));
  EXPECT_TRUE(may_operate("master-0123456789ab"));
  ServedWorld open(paused());
  EXPECT_TRUE(Viewer(open.connectOptions()).run().may_operate);
}

TEST(Viewing, ViewersDoNotAffectTheRun) {
  const auto digest = [](bool is_watched) {
    ServedWorld::Options options;
    options.last_step = 3000;
    options.server.is_paused = true;
    ServedWorld world(options);
    Viewer first(world.connectOptions());
    Panel(world).start();
    for (int i = 0; is_watched && i < 20; ++i) {
      try {
        Viewer viewer(world.connectOptions());
        if (!viewer.waitForFrame()) break;
      } catch (const ConnectionError&) {
        break;  // the run is over
      }
    }
    world.wait();
    return world.digest();
  };
  EXPECT_EQ(digest(true), digest(false));
}

TEST(Viewing, SendsALoadedWorldToAllViewers) {
  ServedWorld world(paused());
  Viewer viewer(world.connectOptions());
  EXPECT_EQ(viewer.run().world.world.name, "small_maze");
  Panel(world).load("worlds/open_100.xml");
  ASSERT_TRUE(viewer.waitForFrame());
  EXPECT_TRUE(viewer.isNewWorld());
  EXPECT_EQ(viewer.run().world.world.name, "open_100");
  EXPECT_EQ(viewer.run().snapshot.robots.size(), 100u);
}

TEST(Viewing, TextViewerPrintsFramesAndReadingsUntilTheRunIsOver) {
  ServedWorld world(paused());
  StartedProgram viewer(ROBOSIM_TEXT_VIEWER, {std::to_string(world.port()), "Scout1"});
  viewer.waitForOutput("step 0; Pioneer1 ");
  Panel(world).step(7);
  viewer.waitForOutput("step 7; Pioneer1 ");
  viewer.waitForOutput("  Scout1; sonar nearest of 16 ");
  world.end();
  const Ended ended = viewer.wait();
  EXPECT_EQ(ended.exit_code, 0);
  EXPECT_EQ(countOf("  Pioneer1; ", ended.out), 0u) << ended.out;
}

TEST(Viewing, ShowsAnInterventionAlsoInAPausedRun) {
  ServedWorld world(paused());
  Panel panel(world);
  Viewer viewer(world.connectOptions());
  EXPECT_FALSE(viewer.run().snapshot.objects.areChanged());
  const WorldObject box{
      .name = "box", .body = {Cube{0.1, 0.1}, {0.5, 0.5, 0}, 5, 0.1}, .line = {}};  // above the robots
  panel.supervise(AddObject{box});
  ASSERT_TRUE(viewer.waitForFrame());
  EXPECT_EQ(viewer.run().snapshot.step, 0u);
  std::vector<WorldObject> expected = viewer.run().world.world.objects;
  expected.push_back(box);
  EXPECT_EQ(viewer.run().snapshot.objects, ChangedObjects(expected));
  EXPECT_EQ(Viewer(world.connectOptions()).run().snapshot.objects, ChangedObjects(expected)) << "one who comes later";
}

}  // namespace
}  // namespace robosim
