#include <algorithm>
#include <functional>
#include <iostream>
#include <map>

#include <CLI/CLI.hpp>

#include "base/whole_file.h"
#include "rendering/stock_scene.h"
#include "rendering/svg_plan.h"
#include "robosim/arguments.h"
#include "robosim/progress.h"
#include "robosim/subcommands.h"
#include "robosim/text.h"
#include "robots/fleet.h"
#include "world/map_writer.h"

namespace robosim {
namespace {

namespace fs = std::filesystem;

struct Arguments {
  std::string world;
  std::vector<std::string> outs;
  double resolution_m = MapExtent().cell_m;
  std::vector<double> heights_m;  ///< none, or from and to
};

/// Files to be written, by path: some formats have two.
using Files = std::map<fs::path, std::string>;

/// What the formats are made from, each made when the first asks for it.
class Source {
 public:
  explicit Source(const Arguments& arguments) : arguments_(arguments), loaded_(loadWorld(arguments.world, {})) {}

  const LoadedWorld& loaded() const { return loaded_; }

  const OccupancyGrid& grid() {
    if (!grid_) grid_ = rasterOf(loaded_.world, extent(heightsOfRobots()));
    return *grid_;
  }

  std::string octomap(OctomapForm form) {
    Progress progress;
    return toOctomap(loaded_.world, extent(heightsOfAll(loaded_.world)), form, [&](double share) {
      if (progress.due()) progress.show("OctoMap: " + fixed(100 * share, 0) + " %");
    });
  }

 private:
  MapExtent extent(const HeightSpan& otherwise) const {
    const auto& heights = arguments_.heights_m;
    return {arguments_.resolution_m, heights.empty() ? otherwise : HeightSpan{heights[0], heights[1]}};
  }

  HeightSpan heightsOfRobots() const {
    std::vector<HeightSpan> robots;
    for (const auto& robot : loaded_.fleet.robots) robots.push_back(robot.body.heights());
    return robotHeights(robots);
  }

  const Arguments& arguments_;
  LoadedWorld loaded_;
  std::optional<OccupancyGrid> grid_;
};

fs::path withEnding(fs::path file, const char* ending) { return file.replace_extension(ending); }

/// The picture and the .yaml, whichever of the two was named.
void makeRosMap(Source& source, const fs::path& out, Files& files) {
  const fs::path picture = withEnding(out, ".png");
  RosMap map = toRosMap(source.grid(), picture.filename().string());
  files[picture] = std::move(map.png);
  files[withEnding(out, ".yaml")] = std::move(map.yaml);
}

/// A format is told by the ending of a file's name. Another one gets a line here.
struct Format {
  const char* ending;
  const char* help;
  std::function<void(Source&, const fs::path& out, Files&)> make;
};

const std::vector<Format>& formats() {
  static const std::vector<Format> all{
      {".gridmap", "MRPT's occupancy grid",
       [](Source& source, const fs::path& out, Files& files) { files[out] = toGridmap(source.grid()); }},
      {".yaml", "ROS's map_server, with its picture in a .png beside it", makeRosMap},
      {".png", "the same, named by the picture", makeRosMap},
      {".bt", "OctoMap, free or occupied",
       [](Source& source, const fs::path& out, Files& files) { files[out] = source.octomap(OctomapForm::binary); }},
      {".ot", "OctoMap, with probabilities",
       [](Source& source, const fs::path& out, Files& files) {
         files[out] = source.octomap(OctomapForm::probabilities);
       }},
      {".3Dscene", "MRPT's SceneViewer3D, with the robots",
       [](Source& source, const fs::path& out, Files& files) {
         files[out] = toStockScene(source.loaded().world, source.loaded().fleet);
       }},
      {".svg", "a plan to scale, with the robots",
       [](Source& source, const fs::path& out, Files& files) {
         files[out] = toSvg(source.loaded().world, source.loaded().fleet);
       }},
  };
  return all;
}

const Format& formatOf(const fs::path& out) {
  std::vector<std::string> endings;
  for (const auto& format : formats()) {
    if (out.extension() == format.ending) return format;
    endings.emplace_back(format.ending);
  }
  throw ConfigError(out.string() + ": is of no known format; give it a name that ends in one of: " + listed(endings));
}

/// The files that a format will write for this name.
std::vector<fs::path> filesOf(const fs::path& out) {
  const std::string ending = formatOf(out).ending;
  if (ending == ".yaml" || ending == ".png") return {withEnding(out, ".yaml"), withEnding(out, ".png")};
  return {out};
}

void check(const Arguments& arguments) {
  if (!arguments.heights_m.empty() && arguments.heights_m[0] >= arguments.heights_m[1]) {
    throw ConfigError("--heights " + toText(arguments.heights_m[0]) + " " + toText(arguments.heights_m[1]) +
                      ": the first must be below the second");
  }
  std::map<fs::path, std::string> outs;
  for (const auto& out : arguments.outs) {
    for (const auto& file : filesOf(out)) outs[file] = out;
  }
  std::vector<std::pair<std::string, fs::path>> all{{"WORLD", arguments.world}};
  for (const auto& [file, out] : outs) {
    all.emplace_back(file == out ? "OUT" : "what belongs to " + out, file);
    checkWritable(file);
  }
  refuseSameFile(all);
}

void exportWorld(const Arguments& arguments) {
  check(arguments);
  Source source(arguments);
  Files files;
  for (const auto& out : arguments.outs) formatOf(out).make(source, out, files);
  // No file takes its name before all are written, so that none is left beside an old one that belonged to it.
  std::vector<std::unique_ptr<WholeFile>> written;
  for (const auto& [file, bytes] : files) {
    written.push_back(std::make_unique<WholeFile>(file));
    written.back()->write(bytes);
    written.back()->finish();
  }
  for (auto& file : written) file->commit();
  for (const auto& [file, bytes] : files) std::cout << file.string() << ": " << withCommas(bytes.size()) << " bytes\n";
}

std::string formatsHelp() {
  Rows rows;
  for (const auto& format : formats()) rows.push_back({"  " + std::string(format.ending), format.help});
  return "Formats, by the ending of OUT:\n" + listing(rows) +
         "Try:  robosim export worlds/opho2_1.xml opho2_1.gridmap opho2_1.yaml opho2_1.bt opho2_1.svg";
}

}  // namespace

void addExport(CLI::App& program) {
  auto* command = program.add_subcommand("export", "Write a world as a map for other programs, or as a plan");
  auto arguments = std::make_shared<Arguments>();
  command->add_option("WORLD", arguments->world, "world file, or a map's file")->type_name("FILE")->required();
  command->add_option("OUT", arguments->outs, "files to write, each of the format that its name ends in")
      ->type_name("FILE")
      ->required()
      ->check(fileName());
  command->add_option("--resolution", arguments->resolution_m, "side of a cell or voxel, metres")
      ->check(numberIn(0.001, kCellMax_m))
      ->type_name("METRES")
      ->capture_default_str();
  command
      ->add_option("--heights", arguments->heights_m,
                   "what stands between these counts, metres above the ground; default: for a grid what may be in a "
                   "robot's way, for an OctoMap everything")
      ->check(numberIn(-1000, 1000))
      ->type_name("LOW HIGH")
      ->expected(2);
  command->footer(formatsHelp());
  command->callback([arguments] { exportWorld(*arguments); });
}

}  // namespace robosim
