#pragma once
#include <filesystem>
#include <string>

#include "base/error_list.h"
#include "world/file_provider.h"
#include "world/world.h"

namespace robosim {

/// Reads a world file (the 2005 format and RoboSim's extensions: doc/world_file.md). Adds all faults to `errors` as
/// "file:line: what; how to fix it" and returns what could be read. Faults reported here: XML, tags, values, duplicate
/// names, unknown neighbours, unreadable maps. The module `robots` reports the others: models, sensors, overlapping
/// robots.
/// @param file may be a map: see readWorldText()
World readWorld(const std::filesystem::path& file, ErrorList& errors);
/// Parses the text of a world file; `file` names it in errors, and `files` provides the maps.
World parseWorld(std::string text, const std::string& file, const FileProvider& files, ErrorList& errors);
/// Parses a world that refers to no other file.
World parseWorld(std::string text, const std::string& file, ErrorList& errors);

/// Whether a file is a world of Stage by the ending of its name, `.world`.
bool isStageFile(const std::filesystem::path& file);

/// A world or a map is read by the ending of its name (recognizeMapFormat()). Refuses a file whose first bytes are of
/// another kind than its name says: a map that does not end as its format does, and any other kind that ends like a
/// map.
/// @throws ConfigError with the ending that it must have
void requireNameOfKind(const std::filesystem::path& file);

/// Text of a world file. For a map file, the text of a world that consists of this map and, if the map gives a start
/// pose, a Pioneer there.
/// @param files files beside it
/// @throws ConfigError when it cannot be read, or is a picture, whose scale is unknown
std::string readWorldText(const std::filesystem::path& file, const FileProvider& files);

/// Text of a world file for the world. parseWorld() of it, with the same maps, gives an equal world.
std::string toXml(const World&);

}  // namespace robosim
