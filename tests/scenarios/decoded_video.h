#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

namespace robosim {

/// A video as FFmpeg decodes it. OpenCV's reader of videos would load 200 libraries with every start of the tests.
struct DecodedVideo {
  std::string codec;         ///< FFmpeg's name: "h264", "vp9"
  std::string pixel_format;  ///< "yuv420p"
  cv::Size size;
  double fps = 0;
  std::vector<cv::Mat> frames;  ///< BGR
};

/// @throws std::runtime_error when the file is no video or is damaged
DecodedVideo decodeVideo(const std::filesystem::path& file);

}  // namespace robosim
