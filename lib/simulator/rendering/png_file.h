#pragma once
#include <filesystem>
#include <string>

#include <opencv2/core/mat.hpp>

namespace robosim {

/// @throws ConfigError when the name does not end in .png, or the file cannot be created. Changes no file.
void checkPngFile(const std::filesystem::path& file);

/// The picture as a PNG file. @throws std::runtime_error when it is too large
std::string encodePng(const cv::Mat& picture);

/// Writes the picture as an AtomicFile.
/// @throws ConfigError as checkPngFile() does, and std::runtime_error when the disk is full.
void writePngFile(const std::filesystem::path& file, const cv::Mat& picture);

}  // namespace robosim
