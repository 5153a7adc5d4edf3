// `robosim view --offscreen` with .mp4, .webm and .webp: format, frames, and the end of a video.
// tests/browser/video_test.mjs plays them.

#include <chrono>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "tests/scenarios/decoded_video.h"
#include "tests/scenarios/foreign_rawlog.h"
#include "tests/scenarios/panel.h"
#include "tests/scenarios/program.h"
#include "tests/scenarios/serving.h"
#include "tests/scenarios/verifying.h"
#include "tests/scenarios/wait.h"

namespace robosim {
namespace {

namespace fs = std::filesystem;

/// Records a robot that wanders in a room of 10 m × 10 m.
fs::path recordWandering(const fs::path& folder, const std::string& seconds) {
  std::ofstream(folder / "room.xml") << R"(<world><surface>
    <size><xmin>0</xmin><xmax>10</xmax><ymin>0</ymin><ymax>10</ymax></size>
    <object><shape><robot><model>pioneer3dx</model><name>Ann</name><x>5</x><y>5</y><color>1 0 0</color>
      <controller>wander</controller></robot></shape></object>
  </surface></world>)";
  const Ended run = runProgram("run " + quoted(folder / "room.xml") + " --time " + seconds + " --record " +
                               quoted(folder / "run.rawlog"));
  EXPECT_EQ(run.exit_code, 0) << run.err;
  return folder / "run.rawlog";
}

void view(const fs::path& recording, const std::string& options, const fs::path& file) {
  const Ended view = runProgram("view " + quoted(recording) + " " + options + " --offscreen " + quoted(file));
  ASSERT_EQ(view.exit_code, 0) << view.err;
}

std::string bytesOf(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Mean difference of channels; encoding and conversion by BT.601 cause about 2.
double differenceOf(const cv::Mat& a, const cv::Mat& b) {
  return cv::norm(a, b, cv::NORM_L1) / static_cast<double>(a.total() * 3);
}

struct Box {
  std::string type;
  std::size_t begin = 0, bytes = 0;  ///< without its header
};

/// The boxes of an MP4 file (ISO/IEC 14496-12, 4.2) within a part of it.
std::vector<Box> boxesIn(const std::string& file, std::size_t begin, std::size_t end) {
  std::vector<Box> boxes;
  while (begin + 8 <= end) {
    std::size_t bytes = 0;
    for (std::size_t i = 0; i < 4; ++i) bytes = bytes << 8 | static_cast<std::uint8_t>(file[begin + i]);
    EXPECT_GE(bytes, 8u);
    EXPECT_LE(bytes, end - begin);
    if (bytes < 8 || bytes > end - begin) break;
    boxes.push_back({file.substr(begin + 4, 4), begin + 8, bytes - 8});
    begin += bytes;
  }
  return boxes;
}

TEST(Video, OfMp4HasItsIndexFirstAndH264) {
  const auto folder = emptyFolder();
  view(recordWandering(folder, "1"), "--size 320x240", folder / "run.mp4");
  const std::string file = bytesOf(folder / "run.mp4");
  std::string types;
  Box box;
  for (const auto& each : boxesIn(file, 0, file.size())) {
    types += each.type + " ";
    if (each.type == "moov") box = each;
  }
  EXPECT_TRUE(types == "ftyp moov mdat " || types == "ftyp moov free mdat ") << types;
  for (const std::string type : {"trak", "mdia", "minf", "stbl", "stsd"}) {
    for (const auto& inner : boxesIn(file, box.begin, box.begin + box.bytes)) {
      if (inner.type == type) box = inner;
    }
    ASSERT_EQ(box.type, type);
  }
  const auto samples = boxesIn(file, box.begin + 8, box.begin + box.bytes);  // after version, flags and count
  ASSERT_EQ(samples.size(), 1u);
  EXPECT_EQ(samples[0].type, "avc1");
}

TEST(Video, HasItsCodecPixelsOf420AndEvenSides) {
  const auto folder = emptyFolder();
  const auto recording = recordWandering(folder, "1");
  for (const std::string name : {"run.mp4", "run.WEBM"}) {
    view(recording, "--size 321x241", folder / name);
    const DecodedVideo video = decodeVideo(folder / name);
    EXPECT_EQ(video.size, cv::Size(320, 240));
    EXPECT_EQ(video.pixel_format, "yuv420p") << name;
    EXPECT_EQ(video.codec, name == "run.WEBM" ? "vp9" : "h264");
    EXPECT_NEAR(video.fps, 20, 1e-6);
  }
}

TEST(Video, OfWebpIsAnAnimationThatRepeats) {
  const auto folder = emptyFolder();
  view(recordWandering(folder, "3"), "--size 320x240 --fps 10", folder / "run.webp");
  const std::string file = bytesOf(folder / "run.webp");
  const auto number = [&](std::size_t at, int bytes) {
    unsigned value = 0;
    for (int i = 0; i < bytes; ++i) value |= static_cast<unsigned>(static_cast<std::uint8_t>(file.at(at + i))) << 8 * i;
    return value;
  };
  // Chunks of the WebP container: name, size, content of even size; those of frames begin with x, y, width, height and
  // duration of 3 bytes each.
  EXPECT_EQ(file.substr(0, 4) + file.substr(8, 4), "RIFFWEBP");
  unsigned loops = 1, frames = 0, duration_ms = 0;
  for (std::size_t at = 12; at + 8 <= file.size(); at += 8 + (number(at + 4, 4) + 1) / 2 * 2) {
    const std::string name = file.substr(at, 4);
    if (name == "ANIM") loops = number(at + 12, 2);
    if (name == "ANMF") ++frames, duration_ms += number(at + 20, 3);
  }
  EXPECT_EQ(loops, 0u) << "for ever";
  EXPECT_GT(frames, 10u);
  EXPECT_EQ(duration_ms, 3100u) << "31 pictures, 10 per second";
}

TEST(Video, IsEqualForEqualRecordings) {
  const auto folder = emptyFolder();
  const auto recording = recordWandering(folder, "1");
  for (const std::string ending : {".mp4", ".webm", ".webp"}) {
    for (const std::string name : {"a", "b"}) view(recording, "--size 160x120", folder / (name + ending));
    EXPECT_EQ(bytesOf(folder / ("a" + ending)), bytesOf(folder / ("b" + ending))) << ending;
  }
}

TEST(Video, EndsWithTheLastStepAtAnySpeed) {
  const auto folder = emptyFolder();
  const auto recording = recordWandering(folder, "3");
  const auto picture_at = [&](const std::string& time) {
    view(recording, "--size 400x400 --to " + time, folder / "step.png");
    return cv::imread((folder / "step.png").string());
  };
  const cv::Mat end = picture_at("3"), step_before = picture_at("2.9");
  EXPECT_GT(differenceOf(end, step_before), 0.05);
  struct Case {
    std::string speed;
    std::size_t frames;
  };
  for (const auto& [speed, frames] : {Case{"0.9", 35}, {"1", 31}, {"7", 6}, {"1000", 2}}) {
    for (const std::string name : {"run.mp4", "run.webm"}) {
      // VP9 takes ten times as long to encode as H.264: ./dev verify suites does so at all speeds.
      if (name == "run.webm" && frames > 10 && !isVerifying()) continue;
      view(recording, "--size 400x400 --fps 10 --speed " + speed, folder / name);
      const auto video = decodeVideo(folder / name).frames;
      ASSERT_EQ(video.size(), frames) << name << " at speed " << speed;
      EXPECT_LT(differenceOf(video.back(), end), differenceOf(video.back(), step_before) - 0.02)
          << name << " at speed " << speed;
      EXPECT_GT(cv::norm(video.back(), video.front(), cv::NORM_INF), 50) << "the robot has moved";
    }
  }
}

/// Pixels of the path and the robot: its red.
cv::Mat redsOf(const cv::Mat& picture) {
  cv::Mat channels[3], reds;
  cv::split(picture, channels);
  cv::subtract(channels[2], channels[1], reds);
  return reds > 40;
}

TEST(Video, ShowsEveryCornerOfAPathAtAnySpeed) {
  const auto folder = emptyFolder();
  const auto recording = recordWandering(folder, "60");
  const auto last_at_speed = [&](const std::string& speed) {
    view(recording, "--size 400x400 --fps 10 --speed " + speed, folder / "run.mp4");
    return redsOf(decodeVideo(folder / "run.mp4").frames.back());
  };
  // At 10 a frame shows ten more steps, a second; ./dev verify suites encodes 600 frames of a step.
  const cv::Mat each_step = last_at_speed(isVerifying() ? "1" : "10"), only_the_ends = last_at_speed("1000");
  const int path_px = cv::countNonZero(each_step);
  EXPECT_GT(path_px, 1000) << "a path of many metres";
  // An inexact encoder changes pixels at the edges of lines.
  cv::Mat wide;
  cv::dilate(only_the_ends, wide, cv::Mat(), cv::Point(-1, -1), 2);
  EXPECT_LT(cv::countNonZero(each_step & ~wide), path_px / 100);
}

TEST(Video, ShowsARecordingFromItsStartToItsEnd) {
  const auto folder = emptyFolder();
  view(recordWandering(folder, "3"), "--size 320x240 --fps 10 --speed 2", folder / "run.mp4");
  const std::vector<cv::Mat> frames = decodeVideo(folder / "run.mp4").frames;
  ASSERT_EQ(frames.size(), 16u) << "3 s at twice the speed, 10 a second, and the last one";
  EXPECT_EQ(frames.front().size(), cv::Size(320, 240));
  EXPECT_GT(cv::norm(frames.front(), frames.back(), cv::NORM_INF), 50) << "the robot has moved";
  EXPECT_FALSE(fs::exists(folder / "run.mp4.part"));
}

TEST(Video, EndsWithItsRecording) {
  const auto folder = emptyFolder();
  view(recordWandering(folder, "1"), "--size 321x241 --fps 10 --to 100", folder / "run.mp4");
  const DecodedVideo video = decodeVideo(folder / "run.mp4");
  EXPECT_EQ(video.size, cv::Size(320, 240)) << "a video has even sides";
  EXPECT_EQ(video.frames.size(), 11u) << "10 a second, and the last one";
}

TEST(Video, OmitsGapsOfYears) {
  const auto folder = emptyFolder();
  writeForeignRawlog(folder / "foreign.rawlog", std::chrono::hours(24 * 365 * 31));
  const std::string command = "view " + quoted(folder / "foreign.rawlog") + " --size 320x240 --fps 10 --offscreen " +
                              quoted(folder / "seen.mp4");
  const Ended part = runProgram(command + " --to 1e6");
  EXPECT_NE(part.err.find("robosim view: nothing was recorded for 999998.9 s, in a gap at 1.1 s"), std::string::npos)
      << part.err;
  const Ended view = runProgram(command);
  EXPECT_EQ(view.exit_code, 0) << view.err;
  EXPECT_NE(view.err.find("robosim view: nothing was recorded for 97761599"), std::string::npos) << view.err;
  EXPECT_NE(view.err.find(" s, in a gap at 1.1 s; omitted from the video"), std::string::npos) << view.err;
  EXPECT_EQ(decodeVideo(folder / "seen.mp4").frames.size(), 11u + 99u)
      << "the first moment for a second, and then 9.8 s";
}

TEST(Video, ReportsAFullDisk) {
  const auto folder = emptyFolder();
  recordWandering(folder, "3");
  for (const std::string name : {"run.mp4", "run.webm"}) {
    for (const char* blocks : {"1", "16"}) {  // of 512 or 1024 bytes: no data, or some frames without the index
      const Ended full =
          runCommand("trap '' XFSZ; ulimit -f " + std::string(blocks) + "; '" ROBOSIM_PROGRAM "' view " +
                     quoted(folder / "run.rawlog") + " --size 320x240 --offscreen " + quoted(folder / name));
      EXPECT_EQ(full.exit_code, 2) << blocks << full.err;
      EXPECT_NE(full.err.find(name + ": the video could not be written ("), std::string::npos) << full.err;
      EXPECT_NE(full.err.find("); free disk space"), std::string::npos) << full.err;
      EXPECT_FALSE(fs::exists(folder / name));
      EXPECT_FALSE(fs::exists(folder / (name + ".part")));
    }
  }
}

TEST(Video, ShowsALiveRunUntilItsEnd) {
  const auto folder = emptyFolder();
  Serving serving({"--paused", "--controller", "wander", "--speed", "10"}, "worlds/opho2_1.xml");
  const auto frames_of = [](const fs::path& file) {
    const DecodedVideo video = decodeVideo(file);
    EXPECT_EQ(video.size, cv::Size(320, 240)) << file;
    return video.frames;
  };
  const std::vector<std::string> view{"view", serving.address(), "--size", "320x240", "--fps", "50", "--offscreen"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), view.begin(), view.end());
    return more;
  };
  const Ended paused = StartedProgram(with({(folder / "paused.mp4").string(), "--for", "0.2"})).wait();
  ASSERT_EQ(paused.exit_code, 0) << paused.err;
  const auto start = frames_of(folder / "paused.mp4");
  EXPECT_LT(cv::norm(start.front(), start.back(), cv::NORM_INF), 50) << "differences by encoding are smaller";

  ControlPanel panel({.address = serving.address()});
  waitUntil("the first viewer has left", [&] { return panel.status().viewers() == 0; });
  StartedProgram program(with({(folder / "run.mp4").string()}));
  waitUntil("the viewer is connected", [&] { return !program.isRunning() || panel.status().viewers() > 0; });
  panel.start();
  waitUntil("the robots move", [&] { return !program.isRunning() || panel.status().step() >= 100; });
  panel.stop();
  const Ended ended = program.wait();
  ASSERT_EQ(ended.exit_code, 0) << ended.err << "it ends with the run";
  // The video may begin late, but its last frame shows a state after the start.
  EXPECT_GT(cv::norm(start.front(), frames_of(folder / "run.mp4").back(), cv::NORM_INF), 50) << "the robots have moved";
}

}  // namespace
}  // namespace robosim
