// What a view shows of recordings and of served runs.
#include <algorithm>
#include <fstream>

#include <gtest/gtest.h>
#include <mrpt/io/CFileGZOutputStream.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/serialization/CArchive.h>

#include "base/rereadable_file.h"
#include "tests/scenarios/panel.h"
#include "tests/scenarios/program.h"
#include "tests/scenarios/served_world.h"
#include "tests/scenarios/wait.h"
#include "viewing/recorded_moments.h"
#include "viewing/view_source.h"

namespace robosim {
namespace {

std::unique_ptr<ViewSource> pausedViewOf(const std::filesystem::path& rawlog) {
  auto view = viewRawlog(rawlog.string(), std::make_unique<RereadableFile>(rawlog));
  view->pause(true);
  return view;
}

TEST(RawlogView, ShowsTheStepOfEveryRecordedTime) {
  const auto rawlog = emptyFolder() / "run.rawlog";
  ASSERT_EQ(runProgram("run worlds/small_maze.xml --controller wander --time 3 --record " + quoted(rawlog)).exit_code,
            0);
  const auto view = pausedViewOf(rawlog);
  for (std::uint64_t step = 0; step <= 30; ++step) {
    view->seek(static_cast<double>(step) * 0.1);
    view->advance(0);
    EXPECT_EQ(view->snapshot().step, step);
  }
}

/// A run in which a robot is added and pushes a box.
std::filesystem::path recordChangingRun(const std::filesystem::path& file) {
  const auto world = file.parent_path() / "changing.xml";
  std::ofstream(world) << R"(<world><surface><size><xmin>-4</xmin><xmax>4</xmax><ymin>-4</ymin><ymax>4</ymax></size>
    <object><shape><primitive><cube><name>box</name><x>1</x><y>0</y><z>0.25</z><width>0.3</width><length>0.3</length><height>0.5</height><movable mass_kg="1"/></cube></primitive></shape></object>
    <object><shape><robot><model>pioneer3dx</model><name>Ann</name><x>0</x><y>0</y></robot></shape></object></surface>
    <at time="1"><add><robot name="Bob" model="scout" x="-2" y="0"/></add></at>
    <at time="2"><place name="box" x="2" y="2"/></at></world>)";
  const Ended ended = runProgram("run " + quoted(world) + " --controller wander --time 4 --record " + quoted(file));
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  return file;
}

class OpenedRecording : public testing::TestWithParam<const char*> {};

// Its steps are read one after the other, and earlier ones in between.
TEST_P(OpenedRecording, ShowsWhatTheWholeShows) {
  const std::string file = recordChangingRun(emptyFolder() / GetParam()).string();
  const auto whole = readMoments(file);
  const auto opened = openMoments(file);
  ASSERT_EQ(opened->times().size(), 1u);
  EXPECT_EQ(opened->world().fleet.robots.size(), 1u) << "the other one has not been added yet";
  const auto expectSame = [&](std::size_t moment) {
    const RunSnapshot shown = opened->at(moment), expected = whole->at(moment);
    EXPECT_EQ(shown.step, expected.step);
    const std::size_t robots = shown.robots.size();
    ASSERT_LE(robots, expected.robots.size());
    EXPECT_TRUE(std::equal(shown.robots.begin(), shown.robots.end(), expected.robots.begin())) << moment;
    EXPECT_EQ(shown.objects, expected.objects) << moment;
  };
  for (std::size_t moment = 0; moment < whole->times().size(); ++moment) {
    expectSame(moment);
    if (moment % 3 == 0) expectSame(moment / 2);
    EXPECT_EQ(opened->extend(), moment + 1 < whole->times().size()) << moment;
  }
  EXPECT_EQ(opened->times(), whole->times());
  EXPECT_EQ(opened->world().fleet.robots.size(), 2u);
  EXPECT_EQ(opened->at(15).robots.size(), 2u);
}

INSTANTIATE_TEST_SUITE_P(Formats, OpenedRecording, testing::Values("run.rawlog", "run.mcap"));

TEST(RawlogView, ShowsTheFirstStepAtOnceAndTheWholeAfterwards) {
  const auto rawlog = recordChangingRun(emptyFolder() / "run.rawlog");
  const auto view =
      viewRawlog(rawlog.string(), std::make_unique<RereadableFile>(rawlog), Pictures::leave_out, Opening::at_once);
  EXPECT_EQ(view->snapshot().step, 0u);
  EXPECT_TRUE(view->readSoFar());
  EXPECT_FALSE(view->isOver());
  view->step();
  EXPECT_TRUE(view->advance(0));
  EXPECT_EQ(view->snapshot().step, 1u);
  while (view->readSoFar()) view->advance(0);
  EXPECT_EQ(view->snapshot().step, 1u) << "it is shown where it was";
  EXPECT_NEAR(*view->duration(), 4, 1e-9);
  EXPECT_EQ(view->world().fleet.robots.size(), 2u);
  EXPECT_GT(view->worldNumber(), 0);
  view->seek(4);
  view->advance(0);
  EXPECT_TRUE(view->isOver());
}

TEST(RawlogView, SkipsGapsOfTenSecondsAtTheSpeedOfTheView) {
  const auto rawlog = emptyFolder() / "foreign.rawlog";
  {
    mrpt::io::CFileGZOutputStream stream(rawlog.string());
    auto archive = mrpt::serialization::archiveFrom(stream);
    for (const double time_s : {0, 15}) {
      mrpt::obs::CObservationOdometry odometry;
      odometry.timestamp = mrpt::Clock::fromDouble(1.6e9 + time_s);
      archive << odometry;
    }
  }
  const auto view = pausedViewOf(rawlog);
  EXPECT_EQ(view->pastGap(0.5, 1), 0.5) << "the first second of a gap is shown";
  EXPECT_NEAR(view->pastGap(5, 1), 15, 1e-6);
  EXPECT_EQ(view->pastGap(5, 2), 5) << "7.5 s at twice the speed";
}

TEST(RecordedMoments, OfTheFileOfOneRobotShowThisRobotOnly) {
  const auto folder = emptyFolder();
  ASSERT_EQ(runProgram("run worlds/small_maze.xml --controller wander --time 1 --rawlog-format sf --record " +
                       quoted(folder / "run.rawlog"))
                .exit_code,
            0);
  const auto moments = readMoments((folder / "run_Scout1.rawlog").string());
  ASSERT_EQ(moments->world().fleet.robots.size(), 1u);
  EXPECT_EQ(moments->world().fleet.robots[0].info.name, "Scout1");
  EXPECT_EQ(moments->at(10).robots.size(), 1u);
  EXPECT_EQ(moments->at(10).step, 10u);
}

TEST(EnvironmentView, NumbersTheWorldsThatItShows) {
  ServedWorld world(paused());
  const auto view = viewEnvironment(world.connectOptions());
  EXPECT_EQ(view->worldNumber(), 0);
  Panel panel(world);
  panel.load("worlds/open_100.xml");
  waitUntil("the view shows the loaded world", [&] {
    panel.status();
    view->advance(0);
    return view->world().world.name == "open_100";
  });
  EXPECT_EQ(view->worldNumber(), 1);
  EXPECT_EQ(view->snapshot().robots.size(), 100u);
}

}  // namespace
}  // namespace robosim
