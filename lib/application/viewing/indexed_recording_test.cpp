// Recordings that are shown by their index, compared with the same that are read in full.
#include "viewing/indexed_recording.h"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "base/rereadable_file.h"
#include "base/testing/test_folder.h"
#include "recording/member_index.h"
#include "recording/observation_writer.h"
#include "recording/rawlog_reader.h"
#include "recording/recording_error.h"
#include "run/outputs/run_note.h"
#include "run/outputs/run_recording.h"
#include "viewing/recorded_moments.h"
#include "viewing/view_source.h"
#include "world/changed_objects.h"

namespace robosim {
namespace {

std::unique_ptr<RecordedMoments> openByIndex(const std::string& file) {
  return openIndexedRecording(file, RunNote::of(file), Pictures::leave_out, 0);
}

const char* const kWorld = R"(<world><surface><size><xmin>-4</xmin><xmax>4</xmax><ymin>-4</ymin><ymax>4</ymax></size>
    <object><shape><primitive><cube><name>box</name><x>1</x><y>0</y><z>0.25</z><width>0.3</width><length>0.3</length>
      <height>0.5</height><movable mass_kg="1"/></cube></primitive></shape></object>
    <object><shape><primitive><cylinder><name>Eve</name><x>-3</x><y>3</y><z>0.9</z><radius>0.25</radius>
      <height>1.8</height><walker speed="1"><to x="3" y="3"/></walker></cylinder></primitive></shape></object>
    <object><shape><robot><model>pioneer3dx</model><name>Ann</name><x>0</x><y>0</y></robot></shape></object>
    <object><shape><robot><model>turtlebot3_burger</model><name>Bob</name><x>2</x><y>-2</y></robot></shape></object></surface>
    <at time="25"><add><robot name="Cid" model="pioneer3dx" x="-2" y="0"/></add></at>
    <at time="30"><place name="box" x="2" y="2"/></at>
    <at time="40"><remove name="Bob"/></at></world>)";
constexpr int kSteps = 600;

/// Records a run with a person, a box that is pushed and placed, a robot that is added and one that is removed.
class IndexedRecordingTest : public TestFolder {
 protected:
  IndexedRecordingTest() { record(kSteps); }

  void record(int steps) const {
    const WorldSource source = completeWorldSource(kWorld, "w.xml");
    const RunOptions options{.environment = {.period_s = 0.1}, .controller = "wander"};
    LocalRun run(loadWorldToRun(source, "wander"), options);
    std::vector<RobotInfo> robots;
    for (const auto& robot : run.environment().fleet().robots) robots.push_back(robot.info);
    RunRecording recording({.file = file_}, robots, makeNote(source, run, options), run.environment().model());
    recording.open();
    recording.write(run.environment().state());
    for (int i = 0; i < steps; ++i) {
      run.step();
      recording.follow(run.environment().fleet());
      recording.write(run.environment().state());
    }
    recording.close(run.environment().state(), RunSummary::of(run));
  }

  void damage(std::uint64_t at) const {
    std::fstream file(file_, std::ios::binary | std::ios::in | std::ios::out);
    file.seekp(static_cast<std::streamoff>(at));
    file << std::string(64, '\xff');
  }

  const std::string file_ = in("run.rawlog").string();
};

/// Whether views show the same: the state of a person's walk, besides the place, is only in lists of all objects, which
/// the other reading keeps less often.
bool areShownAlike(const std::vector<WorldObject>& a, const std::vector<WorldObject>& b) {
  const auto moved = movedBetween(a, b);
  return moved && std::all_of(moved->begin(), moved->end(), [&](std::uint32_t i) {
           return a[i].body.world_from_body == b[i].body.world_from_body &&
                  (!a[i].door || a[i].door->share == b[i].door->share);
         });
}

void expectSame(RecordedMoments& indexed, RecordedMoments& whole, std::size_t moment) {
  const RunSnapshot shown = indexed.at(moment), expected = whole.at(moment);
  EXPECT_EQ(shown.step, expected.step);
  EXPECT_EQ(shown.time_s, expected.time_s);
  ASSERT_EQ(shown.robots.size(), expected.robots.size()) << moment;
  for (std::size_t i = 0; i < shown.robots.size(); ++i) {
    EXPECT_TRUE(shown.robots[i] == expected.robots[i]) << "robot " << i << " at " << moment;
  }
  const auto& of_world = whole.world().world.objects;
  EXPECT_TRUE(areShownAlike(shown.objects.orThose(of_world), expected.objects.orThose(of_world))) << moment;
}

TEST_F(IndexedRecordingTest, ShowsWhatAWholeReadingShowsInAnyOrder) {
  const auto whole = readMoments(file_);
  const auto indexed = openByIndex(file_);
  ASSERT_TRUE(indexed);
  EXPECT_TRUE(indexed->isWhole());
  EXPECT_EQ(indexed->times(), whole->times());
  ASSERT_EQ(indexed->world().fleet.robots.size(), whole->world().fleet.robots.size());
  const std::size_t last = whole->times().size() - 1;
  for (const std::size_t moment : {last, std::size_t{0}, last, last - 1, std::size_t{250}, std::size_t{251}}) {
    expectSame(*indexed, *whole, moment);
  }
  std::mt19937 random(1);
  for (int i = 0; i < 40; ++i) expectSame(*indexed, *whole, random() % (last + 1));
  for (std::size_t moment = 0; moment <= last; moment += 1) expectSame(*indexed, *whole, moment);
}

TEST_F(IndexedRecordingTest, HasThePathsAndEventsOfAWholeReading) {
  const auto whole = readMoments(file_);
  const auto indexed = openByIndex(file_);
  ASSERT_TRUE(indexed);
  ASSERT_EQ(indexed->paths().robots(), whole->paths().robots());
  // Each path deviates by at most 2 cm, the points of the index by 3 mm, and the nearest of the positions compared is
  // within 1.3 cm on the path, as robots drive at most 0.5 m/s. Along the path, a position may be that of another time.
  for (std::size_t robot = 0; robot < whole->paths().robots(); ++robot) {
    for (double time_s = 3; time_s <= 57; time_s += 0.5) {
      const auto shown = indexed->paths().positionAt(robot, time_s);
      if (!shown || !whole->paths().positionAt(robot, time_s)) continue;
      double nearest_m = 1e9;
      for (int i = -60; i <= 60; ++i) {
        const auto expected = whole->paths().positionAt(robot, time_s + 0.05 * i);
        if (expected) nearest_m = std::min(nearest_m, (*shown - *expected).norm());
      }
      EXPECT_LE(nearest_m, 0.06) << robot << " at " << time_s;
    }
  }
  const auto& expected = whole->events().all();
  const auto& shown = indexed->events().all();
  ASSERT_EQ(shown.size(), expected.size());
  for (std::size_t i = 0; i < shown.size(); ++i) {
    EXPECT_EQ(shown[i].time_s, expected[i].time_s);
    EXPECT_EQ(shown[i].event.kind, expected[i].event.kind);
    EXPECT_EQ(shown[i].event.robot, expected[i].event.robot);
    EXPECT_NEAR(shown[i].event.at.x, expected[i].event.at.x, 1e-5);
    EXPECT_NEAR(shown[i].event.at.y, expected[i].event.at.y, 1e-5);
  }
}

TEST_F(IndexedRecordingTest, NeedsAWholeRecordingOfSteps) {
  const auto size = std::filesystem::file_size(file_);
  EXPECT_FALSE(openIndexedRecording(file_, RunNote::of(file_), Pictures::leave_out)) << "it is small";
  const std::string copy = in("copy.rawlog").string();
  {
    RawlogReader reader(file_);
    ObservationWriter writer(copy, "");
    while (const auto observation = reader.next()) writer.write(*observation);
    writer.commit();
  }
  EXPECT_FALSE(openByIndex(copy)) << "a selection may lack anything";
  std::filesystem::resize_file(file_, size - 1);
  EXPECT_FALSE(openByIndex(file_)) << "its index is cut off";
}

TEST_F(IndexedRecordingTest, EndsBeforeDamageThatIsShown) {
  damage(std::filesystem::file_size(file_) / 2);
  const auto indexed = openByIndex(file_);
  ASSERT_TRUE(indexed);
  const std::size_t moments = indexed->times().size();
  EXPECT_EQ(indexed->at(0).step, 0U);
  EXPECT_EQ(indexed->at(moments - 1).step, moments - 1) << "it is after the damage";
  EXPECT_FALSE(indexed->isDamaged());
  std::size_t failed = 0;
  for (std::size_t moment = 0; moment < indexed->times().size(); ++moment) {
    try {
      EXPECT_EQ(indexed->at(moment).step, moment);
    } catch (const RecordingError& error) {
      ++failed;
      EXPECT_EQ(indexed->times().size(), moment);
      EXPECT_NE(std::string(error.what()).find("ends early"), std::string::npos) << error.what();
    }
  }
  EXPECT_EQ(failed, 1U);
  EXPECT_TRUE(indexed->isDamaged());
  EXPECT_NE(indexed->readError().find("ends early"), std::string::npos);
  // Up to there, all is shown that is read in full.
  const auto whole = readMoments(file_);
  EXPECT_TRUE(whole->isDamaged());
  EXPECT_EQ(indexed->times(), whole->times());
}

TEST_F(IndexedRecordingTest, IsReadInFullAfterDamageOfAStepThatAddsARobot) {
  const auto index = MemberIndex::read(file_);
  ASSERT_TRUE(index);
  const auto& members = index->members;
  const auto adds = std::find_if(members.begin(), members.end(),
                                 [](const MemberNote& member) { return (member.flags & MemberNote::adds_robot) != 0; });
  ASSERT_NE(adds, members.end());
  damage(adds->packed + 100);
  EXPECT_FALSE(openByIndex(file_));
  EXPECT_TRUE(readMoments(file_)->isDamaged());
}

TEST_F(IndexedRecordingTest, IsPlayedUpToItsDamage) {
  record(9 * kSteps);
  const auto size = std::filesystem::file_size(file_);
  ASSERT_GE(size, kMinIndexedBytes);
  damage(size / 2);
  const auto open = [this] { return viewRawlog(file_, std::make_unique<RereadableFile>(file_)); };
  const auto view = open();
  const double whole_s = *view->duration();
  view->pause(true);
  double time_s = 0;
  for (; time_s < *view->duration(); time_s += 0.5) {
    view->seek(time_s);
    view->advance(0);
  }
  const double end_s = *view->duration();
  EXPECT_LT(end_s, whole_s * 0.6);
  EXPECT_GT(end_s, whole_s * 0.4);
  EXPECT_LT(time_s, end_s + 1);
  EXPECT_TRUE(view->isDamaged());
  EXPECT_NE(view->remark().find("ends early"), std::string::npos);
  view->seek(whole_s);
  view->advance(0);
  EXPECT_EQ(view->snapshot().time_s, end_s);
  EXPECT_TRUE(view->isOver());
  // What follows the damage is shown where nothing before was.
  const auto other = open();
  other->pause(true);
  other->seek(whole_s);
  other->advance(0);
  EXPECT_EQ(other->snapshot().time_s, whole_s);
  EXPECT_FALSE(other->isDamaged());
  other->seek(end_s + 0.1);
  other->advance(0);
  EXPECT_EQ(other->snapshot().time_s, end_s);
  EXPECT_EQ(*other->duration(), end_s);
}

}  // namespace
}  // namespace robosim
