#include <filesystem>

#include "base/data_folders.h"
#include "base/error_list.h"
#include "base/rereadable_file.h"
#include "base/xml_element.h"
#include "recording/rawlog_file.h"
#include "viewing/view_source.h"
#include "world/map_reader.h"
#include "world/world_file.h"

namespace robosim {

void refuseChanges(const std::string& source, const WorldChanges& changes, const char* what) {
  if (changes.isNone()) return;
  throw ConfigError(source + ": is " + what + "; --robot and --random-robots add to a world or a map only");
}

namespace {

std::unique_ptr<ViewSource> viewFile(const std::string& source, const WorldChanges& changes, std::uint64_t seed,
                                     Pictures pictures, Opening opening) {
  if (isMapFile(source) || isStageFile(source)) return viewWorld(source, changes, seed);
  auto file = std::make_unique<RereadableFile>(source);
  const bool is_text = !looksLikeRawlog(file->path());
  if (is_text && !changes.isNone()) return viewWorld(source, changes, seed);
  if (is_text) return viewWorld(source, readXmlText(file->path()), seed);
  refuseChanges(source, changes, "a recording");
  return viewRawlog(source, std::move(file), pictures, opening);
}

}  // namespace

std::unique_ptr<ViewSource> openView(const std::string& source,
                                     const std::function<ConnectOptions(const std::string& address)>& connect_options,
                                     const WorldChanges& changes, std::uint64_t seed, Pictures pictures,
                                     Opening opening) {
  std::error_code ignored;  // for broken links
  if (std::filesystem::exists(std::filesystem::symlink_status(source, ignored)))
    return viewFile(source, changes, seed, pictures, opening);
  const bool looks_like_file = source.find('/') != std::string::npos || source.ends_with(".xml") ||
                               source.ends_with(".rawlog") || source.ends_with(".mcap") || source.ends_with(".db3") ||
                               source.ends_with(".log") || source.ends_with(".clf") || isMapFile(source) ||
                               isStageFile(source);
  if (looks_like_file)
    throw ConfigError(source + ": there is no such file; give a world, a map, a recording, or HOST:PORT" +
                      searchedText(source));
  if (source.find_first_of(":0123456789") == std::string::npos) {
    throw ConfigError(source + ": is neither a file nor an address; give a world, a map, a recording, or HOST:PORT" +
                      searchedText(source));
  }
  refuseChanges(source, changes, "a running environment");
  return viewEnvironment(connect_options(source));
}

}  // namespace robosim
