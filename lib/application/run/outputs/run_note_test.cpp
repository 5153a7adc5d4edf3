#include "run/outputs/run_note.h"

#include <gtest/gtest.h>

namespace robosim {
namespace {

TEST(RunNote, RoundTripsTheBytesOfMapFiles) {
  // Base64 pads the last group of three bytes.
  for (std::size_t size = 0; size <= 7; ++size) {
    RunNote note;
    note.world.file = "folder/w.xml";
    note.world.text = "<world/>";
    note.world.files["map.png"] = std::string("\0\xff=\x89PNG", 7).substr(0, size);
    const auto read = RunNote::parse(note.text());
    ASSERT_TRUE(read) << size;
    EXPECT_EQ(read->world.file, "w.xml");
    EXPECT_EQ(read->world.text, note.world.text);
    EXPECT_EQ(read->world.files, note.world.files) << size;
  }
}

TEST(RunNote, ContainsTheFirstStepOfARecordingThatWasStartedDuringTheRun) {
  RunNote note;
  EXPECT_EQ(note.text().find("first_step"), std::string::npos) << "as in recordings of earlier versions";
  EXPECT_EQ(RunNote::parse(note.text())->first_step, 0u);
  note.first_step = 15;
  EXPECT_EQ(RunNote::parse(note.text())->first_step, 15u);
}

TEST(RunNote, IsRejectedWithATimeStepThatNoRunHas) {
  const auto is_accepted = [](double period_s) {
    RunNote note;
    note.period_s = period_s;
    return RunNote::parse(note.text()).has_value();
  };
  EXPECT_TRUE(is_accepted(1));
  EXPECT_TRUE(is_accepted(0.001));
  EXPECT_FALSE(is_accepted(1.001));
  EXPECT_FALSE(is_accepted(0));
  EXPECT_FALSE(is_accepted(-0.1));
}

TEST(RunNote, KeepsTheRobotsOfAWorldWhoseMapIsTooLarge) {
  RunNote note;
  note.world = {
      "w.xml", "<world/>", {{"probe", {"probe.xml", "<robot/>"}}}, {{"large.pgm", std::string(2 << 20, 'x')}}};
  const auto read = RunNote::parse(note.text());
  ASSERT_TRUE(read);
  EXPECT_EQ(read->world.text, "");
  EXPECT_TRUE(read->world.files.empty());
  EXPECT_EQ(read->without_files.text, "<world/>");
  EXPECT_EQ(read->without_files.robot_types.at("probe").text, "<robot/>");
  note.world.files["large.pgm"] = "small";
  EXPECT_EQ(RunNote::parse(note.text())->without_files.text, "<world/>");
}

}  // namespace
}  // namespace robosim
