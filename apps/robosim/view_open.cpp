#include <filesystem>
#include <fstream>

#include "base/error_list.h"
#include "robosim/view_source.h"
#include "world/map_reader.h"

namespace robosim {

std::unique_ptr<ViewSource> openView(const std::string& source, ConnectionArguments connection) {
  std::error_code ignored;
  if (std::filesystem::is_directory(source, ignored)) throw ConfigError(source + ": is a folder; name a file in it");
  if (std::filesystem::is_regular_file(source, ignored)) {
    if (isMapFile(source)) return viewWorld(source);
    // XML begins with '<', after blanks or a byte order mark; a rawlog is compressed, or begins with a length.
    std::ifstream file(source, std::ios::binary);
    char first = 0;
    file.get(first);
    const bool is_text =
        first == '<' || first == '\n' || first == '\r' || first == '\t' || first == ' ' || first == '\xef';
    return is_text ? viewWorld(source) : viewRawlog(source);
  }
  const bool looks_like_file = source.find('/') != std::string::npos || source.ends_with(".xml") ||
                               source.ends_with(".rawlog") || isMapFile(source);
  if (looks_like_file)
    throw ConfigError(source + ": there is no such file; give a world, a map, a rawlog, or HOST:PORT");
  if (source.find_first_of(":0123456789") == std::string::npos) {
    throw ConfigError(source + ": is neither a file nor an address; give a world, a map, a rawlog, or HOST:PORT");
  }
  connection.environment = source;
  return viewEnvironment(connection);
}

}  // namespace robosim
