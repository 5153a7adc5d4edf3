#pragma once
#include <filesystem>
#include <string>

#include "base/error_list.h"
#include "world/file_shelf.h"
#include "world/world.h"

namespace robosim {

/// Reads a world file (the 2005 form, and what RoboSim adds: doc/world_file.md). Adds every fault it finds to `errors`
/// as "file:line: what; the mend" and returns what could be read. Faults here: XML, tags, values, names given twice, a
/// neighbour that is no robot, maps that cannot be read. The room `robots` finds the rest: models, sensors, robots that
/// overlap something.
/// @param file may be a map itself: see readWorldText()
World readWorld(const std::filesystem::path& file, ErrorList& errors);
/// The same from text; `file` names it in errors, and maps are taken from the shelf.
World parseWorld(std::string text, const std::string& file, const FileShelf& shelf, ErrorList& errors);
/// The same of a world that names no other file.
World parseWorld(std::string text, const std::string& file, ErrorList& errors);

/// The text of a world file. A map's file stands for a world that is nothing but this map, with a Pioneer where the
/// map says that a robot starts, if it does.
/// @throws ConfigError when it cannot be read, or is a picture, of which nobody knows how large it is.
std::string readWorldText(const std::filesystem::path& file);

/// The world as the text of a world file; parseWorld() of it, with the same maps, gives an equal world.
std::string toXml(const World&);

}  // namespace robosim
