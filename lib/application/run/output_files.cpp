#include "run/output_files.h"

#include "base/error_list.h"
#include "robots/robot_type_includes.h"
#include "world/map_reader.h"

namespace robosim {
namespace {

namespace fs = std::filesystem;

bool isSameFile(const fs::path& a, const fs::path& b) {
  std::error_code none;
  return fs::equivalent(a, b, none) || fs::weakly_canonical(a, none) == fs::weakly_canonical(b, none);
}

fs::path partOf(fs::path file) { return file += ".part"; }

}  // namespace

std::vector<fs::path> listInputFiles(const std::string& world_file, const World& world) {
  std::vector<fs::path> files{world_file};
  const fs::path folder = fs::path(world_file).parent_path();
  for (const auto& map : world.maps) {
    for (const auto& file : filesOfMap(folder / map.file)) files.push_back(file);
  }
  for (const auto& name : world.origin.included) files.push_back(folder / name);
  for (const auto& [name, type] : robotTypesIn(robotTypeFolders(world_file))) {
    files.push_back(type.file);
    for (const auto& file : filesIncludedBy(type)) files.push_back(file);
  }
  return files;
}

void refuseOverwriting(const std::vector<fs::path>& inputs, const std::vector<fs::path>& outputs) {
  for (const auto& output : outputs) {
    if (output.empty()) continue;
    for (const auto& input : inputs) {
      if (!isSameFile(output, input) && !isSameFile(partOf(output), input)) continue;
      throw ConfigError(output.string() + ": would replace " + input.string() +
                        ", which this command reads; choose another name");
    }
  }
}

}  // namespace robosim
