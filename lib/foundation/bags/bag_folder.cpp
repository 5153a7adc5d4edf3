#include <algorithm>

#include "bags/bag.h"
#include "base/error_list.h"
#include "base/input_file.h"

namespace robosim {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kSpace = " \t\r";

std::string_view trimmed(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of(kSpace), text.size()));
  text.remove_suffix(text.size() - (text.find_last_not_of(kSpace) + 1));
  const bool is_quoted = text.size() >= 2 && text.front() == text.back() && (text[0] == '"' || text[0] == '\'');
  return is_quoted ? text.substr(1, text.size() - 2) : text;
}

/// What a metadata.yaml of rosbag2 says of its files.
struct BagMetadata {
  std::vector<std::string> files;
  std::string compression_format, compression_mode;
};

/// Its lines are "key: value", and "- value" below relative_file_paths: (rosbag2_storage, metadata_io).
BagMetadata readMetadata(const fs::path& file) {
  constexpr std::size_t kMaxBytes = std::size_t{1} << 24;
  const std::string text = readWholeFile(file, kMaxBytes, "is it of rosbag2?");
  BagMetadata metadata;
  bool lists_files = false;
  for (std::string_view left = text; !left.empty();) {
    const std::size_t end = std::min(left.find('\n'), left.size());
    const std::string_view line = trimmed(left.substr(0, end));
    left.remove_prefix(std::min(end + 1, left.size()));
    if (lists_files && line.starts_with("- ")) {
      metadata.files.emplace_back(trimmed(line.substr(2)));
      continue;
    }
    const std::size_t colon = line.find(':');
    const std::string_view key = line.substr(0, colon);
    if (colon == std::string_view::npos) continue;
    const std::string value(trimmed(line.substr(colon + 1)));
    lists_files = key == "relative_file_paths";
    if (key == "compression_format") metadata.compression_format = value;
    if (key == "compression_mode") metadata.compression_mode = value;
  }
  return metadata;
}

}  // namespace

std::vector<fs::path> bagFilesIn(const fs::path& folder) {
  const fs::path metadata_file = folder / "metadata.yaml";
  std::vector<fs::path> files;
  if (fs::exists(metadata_file)) {
    const BagMetadata metadata = readMetadata(metadata_file);
    if (!metadata.compression_format.empty() && metadata.compression_mode != "NONE" &&
        metadata.compression_mode != "none") {
      throw ConfigError(metadata_file.string() + ": its messages or files are compressed by rosbag2 (" +
                        metadata.compression_format +
                        "), which is not read; convert it by ros2 bag convert to storage_id: mcap without compression");
    }
    // Only names within the folder: older versions of rosbag2 wrote the folder before the name.
    for (const auto& name : metadata.files) files.push_back(folder / fs::path(name).filename());
  } else {
    std::error_code none;
    for (fs::directory_iterator at(folder, none), end; at != end; at.increment(none)) {
      const fs::path extension = at->path().extension();
      if (extension == ".mcap" || extension == ".db3") files.push_back(at->path());
    }
    std::sort(files.begin(), files.end());
  }
  if (files.empty()) {
    throw ConfigError(
        folder.string() +
        ": is a directory; name a file in it, or the folder of a bag of ROS 2, which has .mcap or .db3 files");
  }
  return files;
}

}  // namespace robosim
