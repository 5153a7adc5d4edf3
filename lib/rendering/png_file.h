#pragma once
#include <filesystem>

#include <opencv2/core/mat.hpp>

namespace robosim {

/// @throws ConfigError when the name does not end in .png, or no file can be made there. Leaves everything as it was.
void checkPngFile(const std::filesystem::path& file);

/// Writes the picture as a WholeFile.
/// @throws ConfigError as checkPngFile() does, and std::runtime_error when there is no room for the file.
void writePngFile(const std::filesystem::path& file, const cv::Mat& picture);

}  // namespace robosim
