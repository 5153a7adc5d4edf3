#include <algorithm>
#include <cctype>
#include <functional>
#include <iostream>
#include <map>
#include <optional>

#include <CLI/CLI.hpp>

#include "base/atomic_file.h"
#include "base/interrupt.h"
#include "base/log.h"
#include "base/printable_text.h"
#include "base/progress.h"
#include "base/text_table.h"
#include "recording/rawlog_file.h"
#include "rendering/plan.h"
#include "rendering/stock_scene.h"
#include "replay/export_recording.h"
#include "robosim/arguments.h"
#include "robosim/command_line.h"
#include "robosim/figure_arguments.h"
#include "robosim/subcommands.h"
#include "robots/fleet.h"
#include "robots/world_source.h"
#include "run/output_files.h"
#include "world/maps/map_writer.h"
#include "world/raster.h"
#include "world/world_file.h"

namespace robosim {
namespace {

namespace fs = std::filesystem;

struct ExportArguments {
  std::string world;
  std::vector<std::string> outs;
  std::optional<double> resolution_m;  ///< default: that of the map, else of MapExtent
  std::vector<double> heights_m;       ///< empty, or minimum and maximum
  WorldChanges changes;
  std::optional<std::uint64_t> seed;  ///< of random places; default: kDefaultSeed
  FigureArguments figure;
  LayerArguments layers;
  RosDistribution distribution = RosDistribution::jazzy;
  int threads = 0;  ///< of a recording; 0: not given
};

/// Files to be written, by path: some formats consist of two files.
using Files = std::map<fs::path, std::string>;

/// Lazily created inputs of the formats.
class Source {
 public:
  Source(const ExportArguments& arguments, Progress& progress)
      : arguments_(arguments),
        progress_(progress),
        loaded_(changedWorld(arguments.world, arguments.changes, {}, arguments.seed.value_or(kDefaultSeed))) {}

  const ExportArguments& arguments() const { return arguments_; }
  const LoadedWorld& loaded() const { return loaded_; }

  const OccupancyGrid& grid() {
    if (!grid_) grid_ = rasterize(loaded_.world, extent(heightsOfRobots()));
    return *grid_;
  }

  /// The grid for a file of MRPT, whose cells lie at multiples of their side. The cells of a map that lie elsewhere are
  /// resampled: a cell is occupied if a solid overlaps it, however little.
  const OccupancyGrid& gridOfMrpt(const fs::path& out) {
    MapExtent extent = this->extent(heightsOfRobots());
    const auto is_multiple = [&](double origin_m) {
      return std::abs(std::remainder(origin_m, extent.cell_m)) <= extent.cell_m / 100;
    };
    if (is_multiple(extent.origin.x) && is_multiple(extent.origin.y)) return grid();
    if (!grid_of_mrpt_) {
      extent.origin = {0, 0};
      grid_of_mrpt_ = rasterize(loaded_.world, extent);
      logWarning("export", out.string() + ": the corner of the map is no multiple of its cell of " +
                               toText(extent.cell_m) +
                               " m, as in all grid maps of MRPT; its cells are resampled, and walls are up to one cell "
                               "thicker");
    }
    return *grid_of_mrpt_;
  }

  std::string octomap(OctomapForm form) {
    return toOctomap(loaded_.world, extent(heightsOfAll(loaded_.world)), form, [&](double share) {
      if (progress_.due()) progress_.show("OctoMap: " + fixed(100 * share, 0) + " %");
    });
  }

 private:
  MapExtent extent(const HeightSpan& otherwise) const {
    MapExtent extent = extentOfMap(loaded_.world).value_or(MapExtent());
    if (arguments_.resolution_m) extent.cell_m = *arguments_.resolution_m;
    const auto& heights = arguments_.heights_m;
    extent.heights = heights.empty() ? otherwise : HeightSpan{heights[0], heights[1]};
    return extent;
  }

  HeightSpan heightsOfRobots() const {
    std::vector<HeightSpan> robots;
    for (const auto& robot : loaded_.fleet.robots) robots.push_back(robot.body().heights());
    return robotHeights(robots);
  }

  const ExportArguments& arguments_;
  Progress& progress_;
  LoadedWorld loaded_;
  std::optional<OccupancyGrid> grid_;
  std::optional<OccupancyGrid> grid_of_mrpt_;
};

fs::path withEnding(fs::path file, const char* ending) { return file.replace_extension(ending); }

std::string lowerCase(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

bool endsWith(const fs::path& file, const std::string& ending) {
  return lowerCase(file.filename().string()).ends_with(lowerCase(ending));
}

/// The .yaml file and its image, of which `out` is one.
std::pair<fs::path, fs::path> rosFiles(const fs::path& out) {
  if (endsWith(out, ".png")) return {withEnding(out, ".yaml"), out};
  return {out, withEnding(out, ".png")};
}

void makeRosMap(Source& source, const fs::path& out, Files& files) {
  const auto [yaml, picture] = rosFiles(out);
  RosMap map = toRosMap(source.grid(), picture.filename().string());
  files[picture] = std::move(map.png);
  files[yaml] = std::move(map.yaml);
}

/// A plan, with the robots at their starts.
void makePlan(Source& source, const fs::path& out, Files& files) {
  const LoadedWorld& loaded = source.loaded();
  DrawnRun start = startOf(loaded.fleet);
  ViewLayers layers = source.arguments().layers.layers();
  layers.only = source.arguments().layers.only().flagsIn(loaded.fleet, RobotSelection::Unmatched::refused);
  applyLayers(start, layers, loaded.world, loaded.fleet);
  files[out] = planPicture(requirePictureFormat(out), loaded.world, loaded.fleet, start);
}

/// Formats by file name extension, case-insensitive. To add a format, add a line here.
struct Format {
  const char* ending;
  const char* help;
  std::function<void(Source&, const fs::path& out, Files&)> make;  ///< of a world; empty for tables of a recording
  std::optional<RecordingFormat> of_recording{};                   ///< nullopt if only of a world
};

const std::vector<Format>& formats() {
  static const std::vector<Format> all{
      {".gridmap", "MRPT's occupancy grid",
       [](Source& source, const fs::path& out, Files& files) { files[out] = toGridmap(source.gridOfMrpt(out)); }},
      {".gridmap.gz", "the same, compressed",
       [](Source& source, const fs::path& out, Files& files) {
         files[out] = gzipped(toGridmap(source.gridOfMrpt(out)));
       }},
      {".yaml", "ROS's map_server, with its image in a .png next to it", makeRosMap},
      {".png", "the same, by the name of the image; of a rawlog: a figure", makeRosMap, RecordingFormat::picture},
      {".bt", "OctoMap, free or occupied",
       [](Source& source, const fs::path& out, Files& files) { files[out] = source.octomap(OctomapForm::binary); }},
      {".ot", "OctoMap, with probabilities",
       [](Source& source, const fs::path& out, Files& files) {
         files[out] = source.octomap(OctomapForm::probabilities);
       }},
      {".3Dscene", "MRPT's SceneViewer3D, with the robots",
       [](Source& source, const fs::path& out, Files& files) {
         const LoadedWorld& loaded = source.loaded();
         ViewLayers layers = source.arguments().layers.layers();
         layers.only = source.arguments().layers.only().flagsIn(loaded.fleet, RobotSelection::Unmatched::refused);
         files[out] = toStockScene(loaded.world, loaded.fleet, layers);
       }},
      {".svg", "a plan to scale, with the robots; of a rawlog: a figure with the trajectories and events", makePlan,
       RecordingFormat::picture},
      {".pdf", "the same", makePlan, RecordingFormat::picture},
      {".html", "of a rawlog: an interactive page of the run, in one file", {}, RecordingFormat::page},
      {".csv", "of a rawlog: one row per robot and step, with all values", {}, RecordingFormat::csv},
      {".npz", "of a rawlog: NumPy's arrays, for each robot and sensor", {}, RecordingFormat::npz},
      {".rawlog", "of a recording: all observations, as an MRPT rawlog", {}, RecordingFormat::rawlog},
      {".mcap", "of a rawlog of RoboSim: topics of ROS 2, for ros2 bag and Foxglove", {}, RecordingFormat::mcap},
  };
  return all;
}

const Format& formatOf(const fs::path& out) {
  std::vector<std::string> endings;
  for (const auto& format : formats()) {
    if (endsWith(out, format.ending)) return format;
    endings.emplace_back(format.ending);
  }
  throw ConfigError(out.string() + ": unknown format; use a name that ends in one of: " + listed(endings));
}

/// Files that the format of this name writes for a world.
std::vector<fs::path> filesOf(const fs::path& out) {
  const std::string ending = formatOf(out).ending;
  if (ending != ".yaml" && ending != ".png") return {out};
  const auto [yaml, picture] = rosFiles(out);
  return {yaml, picture};
}

/// Files that each output consists of.
using FilesByOutput = std::map<std::string, std::vector<fs::path>>;

/// Rejects files that replace an input or cannot be created, in this order, because the latter check creates files.
/// @throws ConfigError
void checkOutputs(const FilesByOutput& outs, const std::vector<fs::path>& inputs) {
  for (const auto& [out, files] : outs) refuseOverwriting(inputs, files);
  for (const auto& [out, files] : outs) {
    for (const auto& file : files) checkWritable(file);
  }
}

void check(const ExportArguments& arguments, const FilesByOutput& outs) {
  if (!arguments.heights_m.empty() && arguments.heights_m[0] >= arguments.heights_m[1]) {
    throw ConfigError("--heights " + toText(arguments.heights_m[0]) + " " + toText(arguments.heights_m[1]) +
                      ": the first must be below the second");
  }
  std::map<fs::path, std::string> out_of;
  for (const auto& [out, files] : outs) {
    for (const auto& file : files) out_of[file] = out;
  }
  std::vector<std::pair<std::string, fs::path>> all{{"WORLD", arguments.world}};
  for (const auto& [file, out] : out_of) {
    all.emplace_back(file == out ? "OUT" : "companion file of " + out, file);
  }
  refuseSameFile(all);
}

void printSize(const fs::path& file, std::uint64_t bytes) {
  std::cout << printableText(file.string()) << ": " << withCommas(bytes) << " bytes\n";
}

bool isRecording(const std::string& file) {
  return fs::is_directory(file) ||
         (fs::is_regular_file(file) && !isMapFile(file) && !isStageFile(file) && looksLikeRawlog(file));
}

/// The outputs of a recording; empty for those of a world. @throws ConfigError
std::vector<RecordingOutput> recordingOutputs(const ExportArguments& arguments) {
  const auto table = std::find_if(arguments.outs.begin(), arguments.outs.end(),
                                  [](const std::string& out) { return !formatOf(out).make; });
  const bool has_table = table != arguments.outs.end();
  if (!has_table && !isRecording(arguments.world)) return {};
  const char* const kind =
      has_table && formatOf(*table).of_recording == RecordingFormat::page ? " is a page" : " is a table";
  const std::string what = has_table ? *table + kind + " of a rawlog" : arguments.world + " is a rawlog";
  std::vector<RecordingOutput> outputs;
  for (const auto& out : arguments.outs) {
    const auto format = formatOf(out).of_recording;
    if (!format)
      throw ConfigError(out + ": can be made of a world only, but " + what + "; export it by another command");
    outputs.push_back({out, *format, arguments.distribution});
  }
  if (arguments.resolution_m || !arguments.heights_m.empty() || arguments.seed) {
    throw ConfigError(what + "; --resolution, --heights and --seed are for worlds");
  }
  if (!arguments.changes.isNone()) throw ConfigError(what + "; options of robots apply to a world or a map only");
  return outputs;
}

void exportOfRecording(const ExportArguments& arguments, const std::vector<RecordingOutput>& outputs) {
  const auto has = [&](RecordingFormat format) {
    return std::any_of(outputs.begin(), outputs.end(), [format](const auto& out) { return out.format == format; });
  };
  if (has(RecordingFormat::picture)) {
    std::vector<std::string> layers = figureLayers();
    std::erase(layers, "sensors");
    arguments.layers.check("a figure of a rawlog by robosim export", layers);
  }
  if (has(RecordingFormat::page)) arguments.layers.check("the page of a run", pageLayers());
  FilesByOutput files;
  for (const auto& output : outputs) files[output.file.string()] = {output.file};
  check(arguments, files);
  checkOutputs(files, {arguments.world});
  for (const auto& output : outputs) {
    const bool is_document = output.format == RecordingFormat::picture && !endsWith(output.file, ".png");
    arguments.figure.check(is_document, output.file.string());
  }
  const Interrupt interrupt;
  const bool is_undamaged =
      exportRecording(arguments.world, outputs, &interrupt, arguments.figure.page(), arguments.layers.layers(),
                      arguments.layers.only(), arguments.threads > 0 ? arguments.threads : threadsForReading());
  for (const auto& output : outputs) printSize(output.file, fs::file_size(output.file));
  if (!is_undamaged) throw Exit{kBadInput};
}

void exportFiles(const ExportArguments& arguments) {
  const auto of_recording = recordingOutputs(arguments);
  if (!of_recording.empty()) return exportOfRecording(arguments, of_recording);
  if (arguments.threads > 0) throw ConfigError("--threads: only recordings are read with several threads; omit it");
  const auto has = [&](std::initializer_list<const char*> endings) {
    return std::any_of(arguments.outs.begin(), arguments.outs.end(), [&](const std::string& out) {
      return std::any_of(endings.begin(), endings.end(), [&](const char* ending) { return endsWith(out, ending); });
    });
  };
  if (has({".svg", ".pdf"})) {
    arguments.layers.check("a plan of a world", {"names", "density"});
  } else if (has({".3Dscene"})) {
    arguments.layers.check("a 3D scene", {"names"});
  } else {
    arguments.layers.check("a map", {}, false);
  }
  FilesByOutput outs;
  for (const auto& out : arguments.outs) {
    arguments.figure.check(false, out);
    outs[out] = filesOf(out);
  }
  check(arguments, outs);
  std::optional<Progress> shown(std::in_place);
  Progress& progress = *shown;
  progress.show("reading " + arguments.world + " …");
  Source source(arguments, progress);
  checkOutputs(outs, listInputFiles(arguments.world, source.loaded().world));
  Files files;
  for (const auto& out : arguments.outs) {
    progress.show("creating " + out + " …");
    formatOf(out).make(source, out, files);
  }
  progress.show("writing …");
  // All files are renamed after all have been written, so that files of different exports never mix.
  std::vector<std::unique_ptr<AtomicFile>> written;
  for (const auto& [file, bytes] : files) {
    written.push_back(std::make_unique<AtomicFile>(file));
    written.back()->write(bytes);
    written.back()->finish();
  }
  for (auto& file : written) file->commit();
  shown.reset();  // clears its line
  for (const auto& [file, bytes] : files) printSize(file, bytes.size());
}

std::string formatsHelp() {
  Rows rows;
  for (const auto& format : formats()) rows.push_back({"  " + std::string(format.ending), format.help});
  return "Formats, by the extension of OUT:\n" + listing(rows) +
         "Try:  robosim export worlds/opho2_1.xml opho2_1.gridmap opho2_1.yaml opho2_1.bt opho2_1.svg\n"
         "      robosim export run.rawlog run.html run.csv run.npz run.pdf";
}

}  // namespace

void addExport(CLI::App& program) {
  auto* command = addSubcommand(program, "export");
  auto arguments = std::make_shared<ExportArguments>();
  command
      ->add_option(
          "WORLD", arguments->world,
          "world file, also of Stage (.world), or map file; or a recording of RoboSim or another program, for "
          ".html, .csv, .npz, .rawlog, .png, .svg and .pdf: an MRPT rawlog, a bag of ROS 2 (.mcap, .db3 or its "
          "folder), or a log of CARMEN (.log, .clf)")
      ->transform(inputFile([] {
        std::vector<FileKind> kinds = kWorldKinds;
        kinds.insert(kinds.end(), kRecordingKinds.begin(), kRecordingKinds.end());
        return kinds;
      }()))
      ->type_name("FILE")
      ->required();
  command->add_option("OUT", arguments->outs, "files to write; the extension selects the format")
      ->type_name("FILE")
      ->required()
      ->check(fileName());
  addRobotOptions(*command, arguments->changes);
  addRandomStartsOption(*command, arguments->changes);
  command->add_option("--seed", arguments->seed, "seed of random places: of robots, starts and <scatter>")
      ->check(seedNumber())
      ->type_name("NUMBER")
      ->default_str(std::to_string(kDefaultSeed))
      ->group(kWorldGroup);
  constexpr const char* kGrids = "an OUT in .gridmap, .gridmap.gz, .yaml, .png, .bt or .ot";
  const auto has_grid = [arguments] {
    return std::any_of(arguments->outs.begin(), arguments->outs.end(), [](const std::string& out) {
      const auto is = [&](const char* ending) { return endsWith(out, ending); };
      return is(".gridmap") || is(".gridmap.gz") || is(".yaml") || is(".png") || is(".bt") || is(".ot");
    });
  };
  dependsOn(command
                ->add_option("--resolution", arguments->resolution_m,
                             "side of a cell or voxel; default: that of the world's map, whose cells are then kept as "
                             "they are, and 0.05 m for a world without a map of cells")
                ->check(numberIn(0.001, kCellMax_m))
                ->type_name("METRES")
                ->group(kGridGroup),
            kGrids, has_grid);
  dependsOn(command
                ->add_option("--heights", arguments->heights_m,
                             "include only objects between these heights above the ground in metres; default: for a "
                             "grid what can collide with a robot, for an OctoMap everything")
                ->check(numberIn(-1000, 1000))
                ->type_name("LOW HIGH")
                ->expected(2)
                ->group(kGridGroup),
            kGrids, has_grid);
  arguments->figure.addTo(*command, {});
  for (CLI::Option* const option : arguments->layers.addTo(*command)) {
    dependsOn(option, "an OUT in .png, .svg, .pdf, .html or .3Dscene", [arguments] {
      return std::any_of(arguments->outs.begin(), arguments->outs.end(), [](const std::string& out) {
        return endsWith(out, ".png") || endsWith(out, ".svg") || endsWith(out, ".pdf") || endsWith(out, ".html") ||
               endsWith(out, ".3Dscene");
      });
    });
  }
  dependsOn(addDistributionOption(*command, arguments->distribution), "an OUT in .mcap", [arguments] {
    return std::any_of(arguments->outs.begin(), arguments->outs.end(),
                       [](const std::string& out) { return endsWith(out, ".mcap"); });
  });
  addReadingThreads(*command, arguments->threads);
  command->footer(formatsHelp());
  command->callback([arguments] { exportFiles(*arguments); });
}

}  // namespace robosim
