#pragma once
#include <filesystem>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

namespace robosim {

/// Kind of an input file, by its first bytes, whatever its name is.
enum class FileKind {
  unknown,  ///< no kind below, or a pipe, which is not looked into
  world,
  robot_type,
  robot_list,  ///< of 2005
  other_xml,
  gridmap,     ///< MRPT's COccupancyGridMap2D
  simple_map,  ///< MRPT's CSimpleMap
  octomap,     ///< .bt and .ot
  ros_yaml,    ///< of ROS's map_server
  picture,     ///< PNG, PGM, PPM or PBM
  bmp,
  jpeg,
  stage_world,  ///< of Stage 2 to 4
  activmedia,   ///< 2D-Map
  rawlog,       ///< MRPT's
  mcap,
  sqlite,  ///< of rosbag2
  carmen_log,
  // Of other programs:
  scene_3d,
  rosbag,
  zip,
  pdf,
};

/// @name Kinds that commands take
///@{
inline const std::vector<FileKind> kWorldKinds{FileKind::world,      FileKind::gridmap,    FileKind::simple_map,
                                               FileKind::octomap,    FileKind::ros_yaml,   FileKind::picture,
                                               FileKind::activmedia, FileKind::stage_world};
inline const std::vector<FileKind> kRecordingKinds{FileKind::rawlog, FileKind::mcap, FileKind::sqlite,
                                                   FileKind::carmen_log};
///@}

/// Kind of a file with these first bytes, decompressed; a few kilobytes suffice.
FileKind kindOfBytes(std::string_view beginning);
/// Kind of a regular file, also of a compressed one; unknown for another file, and for one that cannot be read.
FileKind kindOfFile(const std::filesystem::path& file);

/// What a file of a kind is, with the article, and how to use it: "a rawlog: robosim replay, view, export and fit take
/// it". Kinds of other programs name what can be done with them.
std::string kindText(FileKind kind);

/// Refuses a file of a known kind that is not among those that are taken. The reader of the file reports what is wrong
/// with others, so unknown kinds and other XML pass.
/// @throws ConfigError "FILE: is a rawlog, and not a world or a map; …"
void requireKind(const std::filesystem::path& file, const std::vector<FileKind>& taken);

/// Whether a recording of this name is an MCAP file: one that ends in ".mcap".
bool isMcapName(const std::filesystem::path& file);

}  // namespace robosim
