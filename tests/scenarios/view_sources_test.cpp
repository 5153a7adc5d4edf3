// What a view shows of recordings and of served runs.
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
