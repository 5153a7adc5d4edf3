#pragma once
#include <filesystem>
#include <string>

#include "base/error_list.h"
#include "world/world.h"

namespace robosim {

/// Reads a world file (the 2005 form, and what RoboSim adds: doc/world_file.md). Adds every fault it finds to `errors`
/// as "file:line: what; the mend" and returns what could be read. Faults here: XML, tags, values, names given twice, a
/// neighbour that is no robot. The room `robots` finds the rest: models, sensors, robots that overlap something.
World readWorld(const std::filesystem::path& file, ErrorList& errors);
/// The same from text; `file` names it in errors.
World parseWorld(const std::string& text, const std::string& file, ErrorList& errors);

/// The world as the text of a world file; parseWorld() of it gives an equal world.
std::string toXml(const World&);

}  // namespace robosim
