#include "run/outputs/run_recording.h"

#include <cmath>
#include <fstream>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <mrpt/obs/CObservationComment.h>
#include <mrpt/system/datetime.h>

#include "base/testing/file_size_limit.h"
#include "base/testing/test_folder.h"
#include "recording/observations.h"
#include "recording/rawlog_reader.h"
#include "recording/recording_error.h"

namespace robosim {
namespace {

const char* const kWorld = R"(<world><surface>
  <size><xmin>-3</xmin><xmax>3</xmax><ymin>-3</ymin><ymax>3</ymax></size>
  <object><shape><robot><model>pioneer3dx</model><name>Ann</name><x>0</x><y>0</y></robot></shape></object>
</surface></world>)";

struct RunRecordingTest : TestFolder {
  RunRecording recordingTo(const std::string& name) {
    std::vector<RobotInfo> robots;
    for (const auto& robot : run.environment().fleet().robots) robots.push_back(robot.info);
    return {{.file = in(name)}, robots, makeNote(source, run, options), run.environment().model()};
  }
  /// Takes and records a number of steps.
  void step(RunRecording& recording, int steps) {
    for (int i = 0; i < steps; ++i) {
      run.step();
      recording.write(run.environment().state());
    }
  }
  void stop(RunRecording& recording) { recording.close(run.environment().state(), RunSummary::of(run)); }

  /// Steps of the observations in a file, of its first and last note, and each step once in between.
  std::vector<std::uint64_t> stepsOf(const std::string& name) const {
    std::vector<std::uint64_t> steps;
    RawlogReader reader(in(name));
    bool is_note = true;
    while (const auto observation = reader.next()) {
      const bool was_note = is_note;
      is_note = observation->sensorLabel.empty();
      const auto step = static_cast<std::uint64_t>(
          std::llround(mrpt::system::timeDifference(toTimestamp(SimTime{0, 0.1}), observation->timestamp) / 0.1));
      if (is_note || was_note || steps.back() != step) steps.push_back(step);
    }
    EXPECT_FALSE(reader.readError());
    return steps;
  }

  const WorldSource source = completeWorldSource(kWorld, "w.xml");
  const RunOptions options{.environment = {.period_s = 0.1}, .controller = "still"};
  LocalRun run{loadWorldToRun(source, "still"), options};
};

using Steps = std::vector<std::uint64_t>;
using Names = std::set<std::string>;

TEST_F(RunRecordingTest, BeginsEachPartWithANoteOfItsFirstStep) {
  RunRecording recording = recordingTo("run.rawlog");
  recording.open();
  recording.write(run.environment().state());
  step(recording, 2);
  stop(recording);
  step(recording, 3);  // not recorded
  recording.openNext(run.environment().state());
  step(recording, 1);
  stop(recording);
  EXPECT_EQ(stepsOf("run.rawlog"), (Steps{0, 0, 1, 2, 2}));
  EXPECT_EQ(stepsOf("run_part2.rawlog"), (Steps{5, 5, 6, 6}));
  EXPECT_EQ(RunNote::of(in("run.rawlog")).first_step, 0u);
  EXPECT_EQ(RunNote::of(in("run_part2.rawlog")).first_step, 5u);
}

TEST_F(RunRecordingTest, RecordsNoStepInTwoParts) {
  RunRecording recording = recordingTo("run.rawlog");
  recording.open();
  recording.write(run.environment().state());
  step(recording, 2);
  stop(recording);
  recording.openNext(run.environment().state());
  step(recording, 2);
  stop(recording);
  EXPECT_EQ(stepsOf("run.rawlog"), (Steps{0, 0, 1, 2, 2}));
  EXPECT_EQ(stepsOf("run_part2.rawlog"), (Steps{3, 3, 4, 4}));
  EXPECT_EQ(RunNote::of(in("run_part2.rawlog")).first_step, 3u);
}

TEST_F(RunRecordingTest, OpensTheFirstPartThatDoesNotExist) {
  RunRecording recording = recordingTo("run.rawlog");
  EXPECT_FALSE(recording.isOn());
  EXPECT_EQ(recording.file(), "");
  std::ofstream(in("run.rawlog")) << "another run";
  std::ofstream(in("run_part3.rawlog")) << "another run";
  for (const char* name : {"run_part2.rawlog", "run_part4.rawlog"}) {
    recording.openNext(run.environment().state());
    EXPECT_TRUE(recording.isOn());
    EXPECT_EQ(recording.file(), in(name));
    step(recording, 1);
    stop(recording);
    EXPECT_FALSE(recording.isOn());
  }
  EXPECT_EQ(recording.files(), (std::vector{in("run_part2.rawlog"), in("run_part4.rawlog")}));
  EXPECT_EQ(filesInFolder(), (Names{"run.rawlog", "run_part2.rawlog", "run_part3.rawlog", "run_part4.rawlog"}));
}

TEST_F(RunRecordingTest, DiscardsAPartThatCannotBeCompleted) {
  RunRecording recording = recordingTo("run.rawlog");
  recording.open();
  step(recording, 1);
  stop(recording);
  recording.openNext(run.environment().state());
  step(recording, 1);
  std::filesystem::create_directory(in("run_part2.rawlog"));  // instead of a full disk
  EXPECT_THROW(stop(recording), RecordingError);
  EXPECT_FALSE(recording.isOn());
  EXPECT_EQ(recording.file(), in("run.rawlog"));
  EXPECT_EQ(recording.files(), std::vector{in("run.rawlog")});
  EXPECT_EQ(filesInFolder(), (Names{"run.rawlog", "run_part2.rawlog"})) << "and no unfinished file";
  recording.openNext(run.environment().state());
  step(recording, 1);
  stop(recording);
  EXPECT_EQ(recording.file(), in("run_part3.rawlog"));
}

TEST_F(RunRecordingTest, DiscardsARequestedPartThatCannotBeWritten) {
  RunRecording recording = recordingTo("run.rawlog");
  recording.openNext(run.environment().state());
  step(recording, 1);
  stop(recording);
  recording.openNext(run.environment().state());
  {
    const FileSizeLimit full(10'000);
    while (recording.isOn()) step(recording, 1);  // until a batch of steps is compressed
  }
  EXPECT_NE(recording.failure().find("run_part2.rawlog"), std::string::npos) << recording.failure();
  EXPECT_EQ(recording.file(), in("run.rawlog"));
  EXPECT_EQ(filesInFolder(), Names{"run.rawlog"}) << "and no unfinished file";
  recording.openNext(run.environment().state());
  EXPECT_EQ(recording.failure(), "");
  step(recording, 1);
  stop(recording);
  EXPECT_EQ(recording.files(), (std::vector{in("run.rawlog"), in("run_part2.rawlog")}));
}

TEST_F(RunRecordingTest, DiscardsARequestedPartThatCannotBeCompletedAtTheEndOfTheRun) {
  RunRecording recording = recordingTo("run.rawlog");
  recording.openNext(run.environment().state());
  std::filesystem::create_directory(in("run.rawlog"));  // instead of a full disk
  recording.finish(run.environment().state(), RunSummary::of(run));
  EXPECT_NE(recording.failure().find("run.rawlog"), std::string::npos) << recording.failure();
  EXPECT_TRUE(recording.files().empty());
}

TEST_F(RunRecordingTest, ThrowsWhenTheRecordingOfTheWholeRunCannotBeWritten) {
  RunRecording recording = recordingTo("run.rawlog");
  recording.open();
  const FileSizeLimit full(10'000);
  EXPECT_THROW(step(recording, 100'000), RecordingError);
}

TEST_F(RunRecordingTest, StatesTheOutcomeAtTheEndWithoutWhatDependsOnTheClock) {
  RunRecording recording = recordingTo("run.rawlog");
  recording.open();
  step(recording, 1);
  RunSummary summary = RunSummary::of(run);
  summary.ended_by = EndedBy::recording_stopped;
  summary.wall_s = 5;
  recording.close(run.environment().state(), summary);
  RawlogReader reader(in("run.rawlog"));
  std::optional<RunNote> last;
  while (const auto observation = reader.next()) {
    const auto comment = std::dynamic_pointer_cast<mrpt::obs::CObservationComment>(observation);
    if (comment) last = RunNote::parse(comment->text);
  }
  ASSERT_TRUE(last);
  EXPECT_EQ(last->outcome["ended_by"], "recording_stopped");
  EXPECT_EQ(last->outcome["steps"], 1);
  EXPECT_FALSE(last->outcome.contains("wall_s"));
  EXPECT_FALSE(last->outcome.contains("real_time_factor"));
}

}  // namespace
}  // namespace robosim
