// Recording that control panels start and stop during a served run.
#include <filesystem>
#include <optional>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/testing/file_size_limit.h"
#include "tests/scenarios/program.h"
#include "tests/scenarios/serving.h"

namespace robosim {
namespace {

/// A paused run whose recording is named run.rawlog.
struct RecordedRun {
  explicit RecordedRun(std::vector<std::string> more = {})
      : folder(emptyFolder()), serving([&] {
          more.insert(more.begin(), {"--paused", "--record", (folder / "run.rawlog").string()});
          return more;
        }()) {}

  Ended control(const std::string& words) { return runProgram("control " + serving.address() + " " + words); }
  void must(const std::string& words) {
    const Ended ended = control(words);
    EXPECT_EQ(ended.exit_code, 0) << words << ": " << ended.err;
  }
  /// Ends the run. @return its summary
  std::string end() {
    must("stop");
    return serving.program().wait().out;
  }

  std::filesystem::path folder;
  Serving serving;
};

TEST(RequestedRecording, IsCompleteWhenStoppedAndContinuesInTheNextPart) {
  RecordedRun run;
  const auto first = run.folder / "run.rawlog", second = run.folder / "run_part2.rawlog";
  EXPECT_NE(run.control("status").out.find("on, run.rawlog"), std::string::npos);
  run.must("step 10");
  run.must("record off");
  const Ended check = runProgram("replay --check worlds/small_maze.xml " + quoted(first));
  EXPECT_EQ(check.exit_code, 0) << check.out << check.err;
  EXPECT_TRUE(check.out.starts_with("The same run: 10 steps")) << check.out;
  const Ended whole = runProgram("replay --json " + quoted(first));
  EXPECT_NE(whole.out.find("recording_stopped"), std::string::npos) << whole.out;
  EXPECT_NE(run.control("status").out.find("off, last file run.rawlog"), std::string::npos);

  run.must("step 5");
  run.must("record on");
  run.must("step 5");
  const std::string summary = run.end();
  EXPECT_NE(summary.find(first.string()), std::string::npos) << summary;
  EXPECT_NE(summary.find(second.string()), std::string::npos) << summary;
  EXPECT_EQ(runProgram("replay " + quoted(second)).exit_code, 0);
  const Ended part = runProgram("replay --check worlds/small_maze.xml " + quoted(second));
  EXPECT_EQ(part.exit_code, 1);
  EXPECT_NE(part.err.find("begins at step 15"), std::string::npos) << part.err;
}

TEST(RequestedRecording, IsOffUntilItIsRequestedAndReplacesNoFile) {
  RecordedRun run({"--record-on-request"});
  run.must("step 3");
  EXPECT_TRUE(std::filesystem::is_empty(run.folder));
  std::filesystem::create_directory(run.folder / "run.rawlog");  // anything of that name
  run.must("record on");
  run.must("record on");
  run.must("record off");
  run.must("record off");
  EXPECT_TRUE(std::filesystem::is_directory(run.folder / "run.rawlog"));
  EXPECT_TRUE(std::filesystem::is_regular_file(run.folder / "run_part2.rawlog"));
  EXPECT_FALSE(std::filesystem::exists(run.folder / "run_part3.rawlog"));
  run.end();
}

TEST(RequestedRecording, RepeatsNoStepInTheNextPart) {
  RecordedRun run;
  run.must("step 10");
  run.must("record off");
  run.must("record on");
  run.must("step 5");
  run.end();
  // Steps 11 to 15: five of each channel, of which the first and the last are 0.4 s apart.
  const Ended part = runProgram("replay --json " + quoted(run.folder / "run_part2.rawlog"));
  ASSERT_EQ(part.exit_code, 0) << part.err;
  const auto content = nlohmann::json::parse(part.out);
  EXPECT_EQ(content["duration_s"], 0.4);
  EXPECT_GT(content["channels"].size(), 10u);
  for (const auto& channel : content["channels"]) EXPECT_EQ(channel["count"], 5) << channel;
}

TEST(RequestedRecording, MayHaveNoSteps) {
  RecordedRun run;
  run.must("step 3");
  run.must("record off");
  run.must("record on");  // with the next step
  run.must("record off");
  run.end();
  const Ended none = runProgram("replay --json " + quoted(run.folder / "run_part2.rawlog"));
  ASSERT_EQ(none.exit_code, 0) << none.err;
  const auto content = nlohmann::json::parse(none.out);
  EXPECT_EQ(content["observations"], 0);
  EXPECT_EQ(content["whole"], true);
}

TEST(RequestedRecording, EndsWhenAStepCannotBeWrittenAndTheRunContinues) {
  std::optional<RecordedRun> run;
  {
    const FileSizeLimit full(20'000);
    run.emplace(std::vector<std::string>{"--record-on-request", "--controller", "still"});
  }
  run->must("record on");
  run->must("step 3000");  // several batches of those that are compressed
  const std::string status = run->control("status").out;
  EXPECT_NE(status.find("recording  off\n"), std::string::npos) << status;
  EXPECT_NE(status.find("has ended: "), std::string::npos) << status;
  EXPECT_NE(status.find("run.rawlog: "), std::string::npos) << status;
  run->serving.program().waitForError("the recording has ended: ");
  EXPECT_TRUE(std::filesystem::is_empty(run->folder)) << "the incomplete file is discarded";
  EXPECT_NE(run->end().find("3,000"), std::string::npos) << "the run has continued";
}

TEST(RequestedRecording, IsRefusedWithoutANameForRecordings) {
  Serving serving({"--paused"});
  const Ended refused = runProgram("control " + serving.address() + " record on");
  EXPECT_NE(refused.exit_code, 0);
  EXPECT_NE(refused.err.find("started without --record"), std::string::npos) << refused.err;
  EXPECT_EQ(runProgram("control " + serving.address() + " stop").exit_code, 0);
}

}  // namespace
}  // namespace robosim
