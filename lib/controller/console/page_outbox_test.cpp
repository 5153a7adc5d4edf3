#include "console/page_outbox.h"

#include <optional>
#include <vector>

#include <gtest/gtest.h>

#include "control/testing/fake_hardware.h"
#include "net/robot_wire.h"

namespace robosim {
namespace {

using namespace std::chrono_literals;

struct PageOutboxTest : testing::Test {
  PageOutbox outbox;
  ConsoleFeed feed;
  PageOutbox::Time now{1h};

  PageOutboxTest() { feed.primary.info = std::make_shared<RobotInfo>(FakeHardware().info()); }

  void step(const std::string& jpeg = "") {
    auto update = std::make_shared<RobotUpdate>();
    update->readings = blankReadings(*feed.primary.info->sensors);
    feed.primary.update = update;
    if (!jpeg.empty()) feed.primary.picture = std::make_shared<const RobotPicture>(RobotPicture{1, jpeg});
  }
  void showMap(const std::string& world = "maze") {
    auto map_world = std::make_shared<MapWorld>();
    map_world->name = world;
    auto view = std::make_shared<MapView>();
    view->world = map_world;
    feed.poses = view;
    feed.map.set(R"({"map":")" + world + "\"}");
  }
  /// The next message; "update" for a binary one, "" for none.
  std::string next(bool is_admitted = true) {
    const auto message = outbox.next(feed, is_admitted, now);
    return !message ? "" : message->isBinary() ? "update" : std::string(message->bytes());
  }
};

TEST_F(PageOutboxTest, SendsRepliesAndNotesInTheirOrder) {
  outbox.reply("1");
  outbox.note(std::make_shared<const WebMessage>(WebMessage::text("2")));
  outbox.reply("3");
  EXPECT_EQ(next(), "1");
  EXPECT_EQ(next(), "2");
  EXPECT_EQ(next(), "3");
  EXPECT_EQ(next(), "");
}

TEST_F(PageOutboxTest, RefusesAReplyWhen64MessagesAreQueued) {
  for (int i = 0; i < 64; ++i) EXPECT_TRUE(outbox.reply("reply")) << i;
  EXPECT_FALSE(outbox.reply("reply"));
  EXPECT_EQ(outbox.queued(), 64u);
  next();
  EXPECT_TRUE(outbox.reply("reply"));
}

TEST_F(PageOutboxTest, DropsNotesWhen50MessagesAreQueued) {
  const auto note = std::make_shared<const WebMessage>(WebMessage::text("note"));
  for (int i = 0; i < 1000; ++i) outbox.note(note);
  EXPECT_EQ(outbox.queued(), 50u);
  EXPECT_TRUE(outbox.reply("a reply is not dropped"));
}

TEST_F(PageOutboxTest, SendsAPulseAfter250MillisecondsWithoutAMessage) {
  outbox.reply("welcome");
  next();
  now += 249ms;
  EXPECT_FALSE(outbox.isPulseDue(now));
  EXPECT_EQ(next(), "");
  now += 1ms;
  EXPECT_TRUE(outbox.isPulseDue(now));
  EXPECT_EQ(next(false), "") << "not admitted";
  EXPECT_EQ(next(), R"({"type":"pulse"})");
  EXPECT_EQ(next(), "");
  now += 200ms;
  feed.team.set("team");
  EXPECT_EQ(next(), "team");
  now += 200ms;
  EXPECT_EQ(next(), "") << "the team was a sign of life, too";
}

TEST_F(PageOutboxTest, SendsOnlyTheNewestStateAndOnce) {
  feed.team.set("old team");
  feed.robot.set("robot");
  feed.team.set("team");
  EXPECT_EQ(next(), "robot");
  EXPECT_EQ(next(), "team");
  EXPECT_EQ(next(), "");
  EXPECT_FALSE(feed.team.set("team")) << "unchanged";
  EXPECT_EQ(next(), "");
}

TEST_F(PageOutboxTest, SendsOnlyTheQueueToAPageThatIsNotAdmitted) {
  feed.team.set("team");
  step();
  outbox.reply("refused");
  EXPECT_EQ(next(false), "refused");
  EXPECT_EQ(next(false), "");
}

TEST_F(PageOutboxTest, SendsAtMostThreeUpdatesAheadOfAcknowledgements) {
  for (int i = 0; i < 10; ++i) {
    step();
    now += 1s;
    EXPECT_EQ(next(), i < 3 ? "update" : R"({"type":"pulse"})");
  }
  EXPECT_TRUE(outbox.acknowledge(1, now));
  EXPECT_EQ(outbox.unacknowledged(), 2u);
  EXPECT_EQ(next(), "update") << "the newest only";
  EXPECT_EQ(next(), "");
}

TEST_F(PageOutboxTest, DropsPicturesThatWereSuperseded) {
  for (const char* jpeg : {"first", "second", "third"}) step(jpeg);
  const auto message = outbox.next(feed, true, now);
  EXPECT_TRUE(message->bytes().ends_with("third"));
  EXPECT_EQ(next(), "");
}

TEST_F(PageOutboxTest, SendsUpdatesWithoutPictureAtMostEvery33Milliseconds) {
  step("picture");
  EXPECT_EQ(next(), "update");
  step();
  now += 32ms;
  EXPECT_FALSE(outbox.isUpdateDue(feed, now));
  EXPECT_EQ(next(), "");
  now += 1ms;
  EXPECT_TRUE(outbox.isUpdateDue(feed, now));
  EXPECT_EQ(next(), "update");
  step("a new picture");
  EXPECT_EQ(next(), "update") << "at once";
}

TEST_F(PageOutboxTest, SendsAPictureOnce) {
  step("picture");
  EXPECT_TRUE(outbox.next(feed, true, now)->bytes().ends_with("picture"));
  step();
  now += 1s;
  EXPECT_FALSE(outbox.next(feed, true, now)->bytes().ends_with("picture"));
}

TEST_F(PageOutboxTest, RejectsAnAcknowledgementOfAnUpdateThatWasNotSent) {
  EXPECT_TRUE(outbox.acknowledge(0, now));
  EXPECT_FALSE(outbox.acknowledge(1, now));
  step();
  next();
  EXPECT_TRUE(outbox.acknowledge(1, now));
  EXPECT_FALSE(outbox.acknowledge(UINT64_MAX, now));
  EXPECT_TRUE(outbox.acknowledge(0, now));
  EXPECT_EQ(outbox.unacknowledged(), 0u) << "an old number takes nothing back";
}

TEST_F(PageOutboxTest, IsStuckAfterSixSecondsWithoutAnAcknowledgement) {
  now += 1h;
  EXPECT_FALSE(outbox.isStuck(now)) << "nothing was sent";
  step();
  next();
  now += 6s;
  EXPECT_FALSE(outbox.isStuck(now));
  now += 1ms;
  EXPECT_TRUE(outbox.isStuck(now));
  outbox.acknowledge(0, now);
  EXPECT_TRUE(outbox.isStuck(now)) << "no progress";
  outbox.acknowledge(1, now);
  EXPECT_FALSE(outbox.isStuck(now + 1h));
}

TEST_F(PageOutboxTest, SendsTheMapOnlyToSubscribers) {
  showMap();
  EXPECT_EQ(next(), "");
  outbox.subscribeMap(true);
  EXPECT_EQ(next(), R"({"map":"maze"})");
  EXPECT_NE(next().find("poses"), std::string::npos);
  outbox.subscribeMap(false);
  showMap("other");
  now += 200ms;  // longer than between two poses
  EXPECT_EQ(next(), "");
  outbox.subscribeMap(true);
  EXPECT_EQ(next(), R"({"map":"other"})");
}

TEST_F(PageOutboxTest, SendsPosesAtMostTenTimesPerSecond) {
  outbox.subscribeMap(true);
  int poses = 0;
  for (int i = 0; i < 100; ++i) {
    showMap();
    if (next().find("poses") != std::string::npos) ++poses;
    now += 10ms;
  }
  EXPECT_EQ(poses, 10);
}

TEST_F(PageOutboxTest, SendsThePlacesOfObjectsOnlyWhenTheyHaveMoved) {
  auto world = std::make_shared<MapWorld>();
  world->objects.resize(3);
  world->objects[1].world_from_object = {1, 1, 0};
  const auto show = [&](const std::optional<mrpt::math::TPose2D>& second) {
    auto view = std::make_shared<MapView>();
    view->world = world;
    using Places = std::vector<mrpt::math::TPose2D>;
    if (second) view->world_from_object = std::make_shared<const Places>(Places{{}, *second, {}});
    feed.poses = view;
    now += 100ms;
  };
  outbox.subscribeMap(true);
  feed.map.set("map");
  show(std::nullopt);
  EXPECT_EQ(next(), "map");
  EXPECT_EQ(next(), R"({"type":"poses","step":0,"robots":[]})");
  show({{2, 1.5, 0.25}});
  EXPECT_EQ(next(), R"({"type":"poses","step":0,"robots":[],"objects":[[1,2.0,1.5,0.25]]})");
  show({{2, 1.5, 0.25}});
  EXPECT_EQ(next(), R"({"type":"poses","step":0,"robots":[]})") << "it has stopped";
  outbox.subscribeMap(false);
  outbox.subscribeMap(true);
  EXPECT_EQ(next(), "map");
  now += 100ms;
  EXPECT_EQ(next(), R"({"type":"poses","step":0,"robots":[],"objects":[[1,2.0,1.5,0.25]]})") << "again, with the map";
  show(std::nullopt);
  EXPECT_EQ(next(), R"({"type":"poses","step":0,"robots":[],"objects":[[1,1.0,1.0,0.0]]})")
      << "back, as after a restored state";
}

TEST_F(PageOutboxTest, LeavesOutRangesForAPageThatRequestsThem) {
  step();
  const auto with_sensors = outbox.next(feed, true, now)->bytes().size();
  outbox.subscribeSensors(false);
  step();
  now += 1s;
  EXPECT_LT(outbox.next(feed, true, now)->bytes().size(), with_sensors);
}

TEST(UpdateMessages, AreSerializedOnceForAllPages) {
  ConsoleFeed feed;
  feed.primary.info = std::make_shared<RobotInfo>(FakeHardware().info());
  auto update = std::make_shared<RobotUpdate>();
  update->readings = blankReadings(*feed.primary.info->sensors);
  feed.primary.update = update;
  PageOutbox first, second;
  const PageOutbox::Time now{1h};
  EXPECT_EQ(first.next(feed, true, now), second.next(feed, true, now));
}

}  // namespace
}  // namespace robosim
