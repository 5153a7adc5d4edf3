#pragma once
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "stage/stage_lexer.h"
#include "world/file_provider.h"

namespace robosim::stage {

/// A property as it is written in a file: `size [1 2 0.5]`.
struct Property {
  std::string name;
  std::vector<Token> values;  ///< one, or those of a tuple
  Place place;
  bool is_used = false;   ///< whether the translation has read it, in any of the entities that have it
  bool is_drawn = false;  ///< whether it only determines what Stage draws
  bool is_noted = false;  ///< whether a note about its entity says that it is left out
};

/// An entity with all properties that it has, also from its macros: `pioneer2dx ( name "r0" )`.
struct Entity {
  std::string type;                 ///< as written: a type of Stage, or a macro
  std::string kind;                 ///< type of Stage: of the macro that the others derive from
  std::vector<std::string> macros;  ///< from the one that was written to the one that names the kind
  Place place;
  std::map<std::string, std::shared_ptr<Property>> properties;  ///< by name; instances of a macro share them
  std::vector<Entity> children;                                 ///< those of the macros first
};

/// Maximum numbers that bound the memory which a file takes.
///@{
constexpr std::size_t kEntitiesMax = 500'000;
constexpr int kNestingMax = 64;  ///< of entities, and of included files
constexpr std::size_t kIncludesMax = 1000;
///@}

/// Types of Stage, of its versions 2 to 4.
const std::vector<std::string>& entityKinds();

/// A world file of Stage with the files that it includes.
struct StageFile {
  Entity world;                                        ///< its properties are those outside entities
  std::vector<std::shared_ptr<Property>> assignments;  ///< every one as written, in all files
};

/// Finds a file that a world refers to: relative to the folder of the main file, then by its base name in each folder
/// of $STAGEPATH, then by its base name beside the main file.
/// @return its FileProvider name, and its text
/// @throws UnreadableFile for the first of these places
struct FoundFile {
  std::string name, text;
};
FoundFile findStageFile(const std::string& name, const FileProvider& files);

/// Parses a world file of Stage, and the files that it includes: `include`, `define`, inheritance. As in Stage, the
/// first definition of a name is used, and the last of several assignments of a property.
/// @param file names it in errors
/// @throws ConfigError "file:line: what" with all faults
StageFile parseStageFile(const std::string& text, const std::string& file, const FileProvider& files);

}  // namespace robosim::stage
