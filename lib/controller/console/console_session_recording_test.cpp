// ConsoleSession: starting and stopping the recording of the run.
#include <gtest/gtest.h>

#include "console/testing/console_session_fixture.h"

namespace robosim {
namespace {

TEST_F(ConsoleSessionTest, StartsAndStopsTheRecordingOnceForEachRequest) {
  const PageId ada = driver();
  const std::string on = R"({"type":"record","on":true})", off = R"({"type":"record","on":false})";
  console.send(ada, on);
  EXPECT_TRUE(console.recordings.empty()) << "the run cannot be recorded";
  RecordingView& recording = console.run.recording;
  recording = {.state = RecordingView::State::off, .may_change = true};
  console.update();
  EXPECT_TRUE(received(
      ada, R"("recording":{"state":"off","file":"","may_change":true,"is_changing":false,"problem":"","failure":""})"));
  const PageId bea = console.join("", "Bea");
  console.send(bea, on);
  EXPECT_TRUE(console.recordings.empty()) << "without the control lock";
  console.send(ada, off);
  EXPECT_TRUE(console.recordings.empty()) << "it is off";
  console.send(ada, on);
  recording.is_changing = true;
  console.update();
  console.send(ada, on);
  EXPECT_EQ(console.recordings, std::vector<bool>{true});
  EXPECT_TRUE(console.hasLogged("record on (page of Ada)"));
  recording = {.state = RecordingView::State::on, .file = "run.rawlog", .may_change = true};
  console.update();
  EXPECT_TRUE(received(bea, R"("state":"on","file":"run.rawlog")"));
  console.send(ada, off);
  EXPECT_EQ(console.recordings, (std::vector<bool>{true, false}));
  EXPECT_TRUE(console.hasLogged("record off (page of Ada)"));
  recording.problem = "the disk is full";
  console.update();
  for (const PageId page : {ada, bea}) {
    EXPECT_TRUE(received(page, R"("The recording could not be changed.","warning":true,"detail":"the disk is full")"));
  }
  recording = {.state = RecordingView::State::off, .may_change = true, .failure = "the file is too large"};
  console.update();
  EXPECT_TRUE(received(bea, R"("The recording has ended early.","warning":true,"detail":"the file is too large")"));
}

TEST_F(ConsoleSessionTokensTest, StartsTheRecordingOnlyForOperators) {
  console.run.recording = {.state = RecordingView::State::off, .may_change = true};
  console.update();
  const PageId ada = driver("Ada", kAnnAndBob);
  console.send(ada, R"({"type":"record","on":true})");
  EXPECT_TRUE(received(ada, "Your token does not permit recording the run."));
  EXPECT_TRUE(console.recordings.empty());
  EXPECT_EQ(holder(), ada) << "it may still drive";
  console.send(ada, R"({"type":"release"})");
  console.send(driver("Olga", kOperator), R"({"type":"record","on":true})");
  EXPECT_EQ(console.recordings, std::vector<bool>{true});
}

}  // namespace
}  // namespace robosim
