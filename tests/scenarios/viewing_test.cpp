// Viewers, which may come, look, dawdle and go as they like.
#include <algorithm>
#include <future>
#include <thread>
#include <utility>

#include <gtest/gtest.h>

#include "net/viewing.grpc.pb.h"
#include "net/wire_error.h"
#include "server/viewer.h"
#include "tests/scenarios/panel.h"
#include "tests/scenarios/program.h"
#include "tests/scenarios/served_world.h"

namespace robosim {
namespace {

/// A viewer that shows what comes over the wire.
class RawViewer {
 public:
  explicit RawViewer(const DialOptions& options)
      : stub_(wire::Viewing::NewStub(dial(options))), stream_(stub_->Watch(&context_)) {}
  ~RawViewer() {
    context_.TryCancel();
    if (stream_) stream_->Finish();
  }
  RawViewer(const RawViewer&) = delete;
  RawViewer& operator=(const RawViewer&) = delete;

  void ask(const ReadingsWish& wish = {}, bool amends = false) {
    wire::FrameRequest request;
    request.set_protocol(kProtocolVersion);
    encode(wish, request);
    request.set_amends(amends);
    stream_->Write(request);
  }
  void talkNonsense() {
    wire::FrameRequest request;
    wire::FrameRequest::GetReflection()->MutableUnknownFields(&request)->AddLengthDelimited(3, "\xff");
    stream_->Write(request);
  }
  void sayNothingMore() { stream_->WritesDone(); }
  grpc::Status howItEnds() {
    for (wire::Frame frame; stream_->Read(&frame);) {
    }
    return std::exchange(stream_, nullptr)->Finish();
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
  for (int i = 0; i < 1000; ++i) deaf.ask();
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

void expectReadings(const Sight& sight, const ServedWorld& world, const std::vector<std::size_t>& of) {
  for (std::size_t i = 0; i < sight.robots.size(); ++i) {
    const Readings* readings = sight.readingsOf(i);
    ASSERT_EQ(readings != nullptr, std::find(of.begin(), of.end(), i) != of.end()) << i;
    if (!readings) continue;
    EXPECT_EQ(readings->measurements, world.state().readings[i].measurements) << i;
  }
}

TEST(Viewing, LetsAViewerGoThatNeverReadsAndTalksNonsense) {
  ServedWorld::Options options = paused();
  options.world = "worlds/open_100.xml";
  ServedWorld world(options);
  RawViewer deaf(world.dialOptions());
  Panel panel(world);
  for (int i = 1; i <= 200; ++i) {  // far more than goes out before the first is taken
    deaf.ask({.of_all = true, .of = {}});
    panel.step(1);
  }
  EXPECT_EQ(panel.status().viewers(), 1u);
  deaf.talkNonsense();
  while (panel.status().viewers() > 0) std::this_thread::yield();
  EXPECT_EQ(countOf("hung up on: a message that is no robosim.wire.FrameRequest", world.log()), 1u);
}

TEST(Viewing, AnswersWhoAsksOnceAndHasNothingMoreToSay) {
  ServedWorld world(paused());
  RawViewer viewer(world.dialOptions());
  viewer.ask();
  viewer.sayNothingMore();
  EXPECT_EQ(viewer.read().robots_size(), 2);
  EXPECT_TRUE(viewer.howItEnds().ok());
}

TEST(Viewing, ShowsTheReadingsOfWhomTheViewerWishesAndOfNobodyElse) {
  ServedWorld world(paused());
  Viewer viewer(world.dialOptions(), {.of_all = true, .of = {}});
  expectReadings(viewer.sight(), world, {0, 1});
  viewer.want({.of_all = false, .of = {1}});
  Panel(world).step(5);
  ASSERT_TRUE(viewer.look());
  EXPECT_EQ(viewer.sight().step, 5u);
  expectReadings(viewer.sight(), world, {1});
  viewer.want({});
  ASSERT_TRUE(viewer.look()) << "the wish is another, so the step in sight comes once more";
  EXPECT_EQ(viewer.sight().step, 5u);
  expectReadings(viewer.sight(), world, {});
}

TEST(Viewing, ShowsAPausedRunOnceMoreWhenTheWishChangesWhileTheViewerWaits) {
  ServedWorld world(paused());
  RawViewer viewer(world.dialOptions());
  viewer.next();
  viewer.ask();  // nothing has changed, so there is no answer as yet
  viewer.ask({.of_all = false, .of = {0}}, true);
  const wire::Frame frame = viewer.read();
  EXPECT_EQ(frame.step(), 0u);
  ASSERT_EQ(frame.readings_size(), 1);
  EXPECT_EQ(frame.readings(0).robot(), 0u);
  viewer.ask({.of_all = true, .of = {}}, true);  // asks for no frame
  Panel(world).step(1);
  viewer.ask({.of_all = true, .of = {}});
  EXPECT_EQ(viewer.read().step(), 1u) << "one frame for each request";
}

TEST(Viewing, EndsALookThatWaitsWhenItsOwnerLeaves) {
  ServedWorld world(paused());
  Viewer viewer(world.dialOptions());
  auto look = std::async(std::launch::async, [&] { return viewer.look(); });
  viewer.leave();
  EXPECT_FALSE(look.get());
  EXPECT_FALSE(viewer.look());
}

TEST(Viewing, TellsAViewerWhetherItsTokenIsAControlPanelsToo) {
  ServedWorld::Options options = paused();
  options.server.access = Access::parse("viewer-0123456789ab viewer\nmaster-0123456789ab operator\n", "tokens");
  ServedWorld world(options);
  const auto may_operate = [&](const std::string& token) {
    DialOptions dialled = world.dialOptions();
    dialled.token = token;
    return Viewer(dialled).sight().may_operate;
  };
  EXPECT_FALSE(may_operate("viewer-0123456789ab"));
  EXPECT_TRUE(may_operate("master-0123456789ab"));
  ServedWorld open(paused());
  EXPECT_TRUE(Viewer(open.dialOptions()).sight().may_operate);
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

TEST(Viewing, TellsTheTextViewerEachFrameAndReadingsUntilTheRunIsOver) {
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

}  // namespace
}  // namespace robosim
