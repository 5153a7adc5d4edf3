#pragma once
#include <filesystem>

namespace robosim {

/// Whether a file that is a world or a recording is a recording: a folder (of rosbag2), or by its first byte. XML
/// begins with '<', after white space or a byte order mark; a rawlog is compressed, or begins with a length. An empty
/// file is a recording unless its name ends in .xml.
/// @param file not a pipe, of which this would take the byte
/// @throws ConfigError as InputFile does
bool looksLikeRawlog(const std::filesystem::path& file);

}  // namespace robosim
