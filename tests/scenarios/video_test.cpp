// `robosim view --offscreen` with .mp4 and .webm: format, frames, and the end of a video. tests/browser/video_test.mjs
// plays them.

#include <cstdint>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>

#include "tests/scenarios/program.h"

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

std::vector<cv::Mat> framesOf(const fs::path& file) {
  cv::VideoCapture video(file.string());
  EXPECT_TRUE(video.isOpened());
  std::vector<cv::Mat> frames;
  for (cv::Mat frame; video.read(frame);) frames.push_back(frame.clone());
  return frames;
}

std::string bytesOf(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Mean difference of channels; encoding and OpenCV's decoding by BT.601 cause about 2.
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

std::string fourLetters(double code) {
  const auto number = static_cast<std::uint32_t>(code);
  std::string letters;
  for (int i = 0; i < 4; ++i) letters += static_cast<char>(number >> 8 * i & 0xff);
  return letters;
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
    const cv::VideoCapture video((folder / name).string());
    ASSERT_TRUE(video.isOpened()) << name;
    EXPECT_EQ(video.get(cv::CAP_PROP_FRAME_WIDTH), 320);
    EXPECT_EQ(video.get(cv::CAP_PROP_FRAME_HEIGHT), 240);
    EXPECT_EQ(fourLetters(video.get(cv::CAP_PROP_CODEC_PIXEL_FORMAT)), "I420") << name;
    EXPECT_EQ(bytesOf(folder / name).find("V_VP9") != std::string::npos, name == "run.WEBM");
    EXPECT_NEAR(video.get(cv::CAP_PROP_FPS), 20, 1e-6);
  }
}

TEST(Video, IsEqualForEqualRecordings) {
  const auto folder = emptyFolder();
  const auto recording = recordWandering(folder, "1");
  for (const std::string ending : {".mp4", ".webm"}) {
    for (const std::string name : {"a", "b"}) view(recording, "--size 320x240", folder / (name + ending));
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
      view(recording, "--size 400x400 --fps 10 --speed " + speed, folder / name);
      const auto video = framesOf(folder / name);
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
    return redsOf(framesOf(folder / "run.mp4").back());
  };
  const cv::Mat each_step = last_at_speed("1"), only_the_ends = last_at_speed("1000");
  const int path_px = cv::countNonZero(each_step);
  EXPECT_GT(path_px, 1000) << "a path of many metres";
  // An inexact encoder changes pixels at the edges of lines.
  cv::Mat wide;
  cv::dilate(only_the_ends, wide, cv::Mat(), cv::Point(-1, -1), 2);
  EXPECT_LT(cv::countNonZero(each_step & ~wide), path_px / 100);
}

}  // namespace
}  // namespace robosim
