#include <algorithm>
#include <filesystem>
#include <sstream>

#include <CLI/CLI.hpp>

#include "base/data_folders.h"
#include "base/error_list.h"
#include "base/file_kind.h"
#include "base/log.h"
#include "base/text_table.h"
#include "rendering/offscreen_renderer.h"
#include "rendering/panes.h"
#include "robosim/arguments.h"
#include "robosim/command_line.h"
#include "robosim/connection.h"
#include "robosim/figure_arguments.h"
#include "robosim/foxglove_options.h"
#include "robosim/subcommands.h"
#include "robosim/web_options.h"
#include "robots/robot_selection.h"
#include "run/output_files.h"
#include "viewing/video_file.h"
#include "viewing/view_foxglove.h"
#include "viewing/view_keys.h"
#include "viewing/view_outputs.h"
#include "viewing/view_page.h"
#include "viewing/view_source.h"
#include "world/world_file.h"

namespace robosim {
namespace {

struct ViewArguments {
  std::string source;
  ConnectionArguments connection;
  FoxgloveArguments foxglove;
  std::string web;
  ListenerArguments listener;
  WorldChanges changes;
  std::uint64_t seed = 1;
  bool is_2d = false, is_3d = false;
  std::vector<std::string> follow;
  std::vector<std::string> views;
  ViewTimes times;
  std::string offscreen;
  std::string size = "1280x800";
  bool has_size = false, has_scale = false;
  Panes::Look look;
  FigureArguments figure;
  LayerArguments layers;
};

std::optional<std::size_t> robotNamed(const std::string& name, const Fleet& fleet, AbsentRobots absent) {
  for (std::size_t i = 0; i < fleet.robots.size(); ++i) {
    if (fleet.robots[i].info.name == name) return i;
  }
  if (absent == AbsentRobots::not_followed) return std::nullopt;
  throw ConfigError(describeUnknownRobot(name, fleet));
}

/// "2d", "3d@Pioneer1"
Pane paneFrom(const std::string& text, const LoadedWorld& world, AbsentRobots absent) {
  const auto at = text.find('@');
  const std::string kind = text.substr(0, at);
  if (kind != "2d" && kind != "3d") throw ConfigError("--view " + text + ": must be 2d, 3d, 2d@ROBOT or 3d@ROBOT");
  std::optional<std::size_t> follow;
  if (at != std::string::npos) follow = robotNamed(text.substr(at + 1), world.fleet, absent);
  return makePane(kind == "3d", follow, world.world);
}

std::vector<Pane> panesFor(const ViewArguments& a, const LoadedWorld& world, AbsentRobots absent) {
  std::vector<Pane> panes;
  const auto add = [&](bool is_3d) {
    if (a.follow.empty()) panes.push_back(makePane(is_3d, std::nullopt, world.world));
    for (const auto& name : a.follow) {
      panes.push_back(makePane(is_3d, robotNamed(name, world.fleet, absent), world.world));
    }
  };
  if (a.is_2d || (!a.is_3d && a.views.empty())) add(false);
  if (a.is_3d) add(true);
  for (const auto& view : a.views) panes.push_back(paneFrom(view, world, absent));
  constexpr std::size_t kMaxPanes = 16;
  if (panes.size() > kMaxPanes) throw ConfigError("a picture has at most 16 views; use fewer");
  return panes;
}

Size sizeFrom(const std::string& text) {
  Size size;
  char end = 0;
  if (std::sscanf(text.c_str(), "%dx%d%c", &size.width_px, &size.height_px, &end) != 2 || size.width_px < 64 ||
      size.height_px < 64 || size.width_px > 7680 || size.height_px > 4320) {
    throw ConfigError("--size " + text + ": must be WIDTHxHEIGHT in pixels, from 64x64 to 7680x4320");
  }
  return size;
}

/// @throws ConfigError for options of pictures, which a figure does not have
void checkFigure(const ViewArguments& a) {
  const std::pair<bool, const char*> pictures_only[] = {
      {a.is_3d, "3d"},        {!a.follow.empty(), "follow"},   {!a.views.empty(), "view"},     {a.has_size, "size"},
      {a.has_scale, "scale"}, {a.look.antialias, "antialias"}, {a.look.camera_inset, "camera"}};
  for (const auto& [is_given, option] : pictures_only) {
    if (!is_given) continue;
    throw ConfigError("--" + std::string(option) + ": applies to pictures and videos, and " + a.offscreen +
                      " is a figure of the whole world from above; omit it, or write a .png" +
                      (a.has_size || a.has_scale ? "; --width-mm and --font-pt set sizes in a figure" : ""));
  }
}

/// 100 → "100", 59.9 → "59.9".
std::string brief(double number) {
  std::ostringstream text;
  text << number;
  return text.str();
}

/// @throws ConfigError for options that would have no effect, or show nothing.
void checkTimes(const ViewArguments& a, const ViewSource& source) {
  const ViewTimes& times = a.times;
  const auto duration_s = source.duration();
  const auto refuse = [](bool is_given, const std::string& option, const std::string& why) {
    if (is_given) throw ConfigError("--" + option + ": " + why);
  };
  for (const auto& [option, given] : {std::pair{"from", times.from_s}, {"to", times.to_s}, {"speed", times.speed}}) {
    refuse(given && !duration_s, option, "applies to recordings only, and " + a.source + " is not one");
  }
  refuse(times.speed && !a.offscreen.empty() && !isVideo(a.offscreen), "speed", "applies to videos only; omit it");
  refuse(times.for_s && (!isVideo(a.offscreen) || duration_s), "for", "applies to videos of live runs only; omit it");
  if (!times.from_s) return;
  const std::string from = "from " + brief(*times.from_s);
  refuse(times.to_s && *times.to_s < *times.from_s, from, "is later than --to " + brief(*times.to_s));
  refuse(*times.from_s > *duration_s, from, "the recording ends at " + brief(*duration_s) + " s");
}

/// @throws ConfigError
FoxgloveOptions foxgloveOptions(const ViewArguments& a) {
  const auto log = [](const std::string& line) { logInfo("view", line); };
  return {foxgloveServer(a.foxglove, a.listener.identity(), a.listener.access(log), a.listener.unprotected, log)};
}

bool isRecording(const std::filesystem::path& file) {
  return std::find(kRecordingKinds.begin(), kRecordingKinds.end(), kindOfFile(file)) != kRecordingKinds.end();
}

LivePageServer::Options pageOptions(const ViewArguments& a) {
  const auto log = [](const std::string& line) { logInfo("view", line); };
  return livePageServer(a.web, a.listener.identity(), a.listener.access(log), a.listener.unprotected, log);
}

void view(ViewArguments a) {
  if (const auto file = findDataFile(a.source)) {
    a.source = file->string();
    std::vector<FileKind> kinds = kWorldKinds;
    kinds.insert(kinds.end(), kRecordingKinds.begin(), kRecordingKinds.end());
    requireKind(*file, kinds);
    requireNameOfKind(*file);
  }
  const Size size = sizeFrom(a.size);
  a.figure.check(isFigure(a.offscreen), a.offscreen);
  if (isFigure(a.offscreen)) {
    a.layers.check("a figure of a step", figureLayers());
  } else {
    a.layers.check(a.offscreen.empty() ? "a window" : "a picture or video", windowLayers());
  }
  if (isFigure(a.offscreen)) checkFigure(a);
  if (!a.offscreen.empty()) {
    checkOffscreenFile(a.offscreen);
    refuseSameFile({{"SOURCE", a.source}, {"--offscreen", a.offscreen}});
  }
  if (!a.web.empty() && findDataFile(a.source) && isRecording(a.source)) {
    refuseChanges(a.source, a.changes, "a recording");
    if (!serveRecordingPage(a.source, pageOptions(a))) throw Exit{kBadInput};
    return;
  }
  const auto connect_options = [connection = a.connection](const std::string& address) mutable {
    connection.environment = address;
    return connection.awaitServer(connection.connectOptions(), "view");
  };
  const bool is_served = !a.foxglove.address.empty() || !a.web.empty();
  std::optional<FoxgloveOptions> foxglove;
  if (!a.foxglove.address.empty()) foxglove = foxgloveOptions(a);
  std::optional<LivePageServer::Options> page;
  if (!a.web.empty()) page = pageOptions(a);
  const auto source = openView(
      a.source, connect_options, a.changes, a.seed, is_served ? Pictures::keep : Pictures::leave_out,
      a.offscreen.empty() && !is_served && !a.times.from_s && !a.times.to_s ? Opening::at_once : Opening::whole);
  refuseOverwriting(source->inputs(), {a.offscreen});
  checkTimes(a, *source);
  if (page) return serveViewPage(*source, *page);
  if (foxglove) return serveView(*source, *foxglove, a.times);
  const auto make_panes = [&a](const LoadedWorld& world, AbsentRobots absent) { return panesFor(a, world, absent); };
  if (a.offscreen.empty()) {
    return showWindow(*source, make_panes, size, a.times, a.look, a.layers.layers(), a.layers.only());
  }
  if (isFigure(a.offscreen)) {
    writeViewFigure(*source, a.times, a.offscreen, a.figure.page(kColumnPage), a.layers.layers(), a.layers.only());
  } else {
    writeOffscreen(*source, make_panes, size, a.times, a.offscreen, a.look, a.layers.layers(), a.layers.only());
  }
  if (source->isDamaged()) throw Exit{kBadInput};
}

}  // namespace

void addView(CLI::App& program) {
  auto* command = addSubcommand(program, "view");
  auto a = std::make_shared<ViewArguments>();
  command
      ->add_option("SOURCE", a->source,
                   "address of a running environment (HOST:PORT), a world file, a map, or a recording of any program "
                   "(rawlog, bag of ROS 2, or log of CARMEN); shipped "
                   "files also by name alone: maze_20x20")
      ->type_name("ADDRESS|FILE")
      ->required();
  addRobotOptions(*command, a->changes);
  addRandomStartsOption(*command, a->changes);
  addNoiseOption(*command, a->changes);
  addSeedOption(*command, a->seed, "worlds: seed of random places, of robots, starts and <scatter>, and of noise");
  command->add_flag("--2d", a->is_2d, "from above, to scale (the default)");
  command->add_flag("--3d", a->is_3d, "in perspective; may be combined with --2d");
  command->add_option("--follow", a->follow, "follow this robot; repeatable, adds a view each")->type_name("ROBOT");
  command->add_option("--view", a->views, "add a view: 2d, 3d, 2d@ROBOT or 3d@ROBOT; repeatable")->type_name("VIEW");
  command
      ->add_option("--offscreen", a->offscreen,
                   "no window: write a picture (.png), or a figure for print (.svg, .pdf), of the start of a world, "
                   "the end of a recording, or the newest step of a run; or a video (.mp4: H.264, .webm: VP9, .webp: "
                   "animated picture)")
      ->type_name("FILE")
      ->check(fileName());
  command->add_option("--size", a->size, "size of the window or the picture, pixels")
      ->type_name("WxH")
      ->capture_default_str()
      ->each([a](const std::string&) { a->has_size = true; });
  command->add_option("--scale", a->look.scale, "size of text and lines, for large screens and print")
      ->type_name("FACTOR")
      ->check(numberIn(0.5, 8))
      ->capture_default_str()
      ->each([a](const std::string&) { a->has_scale = true; });
  a->figure.addTo(*command, kColumnPage);
  a->layers.addTo(*command);
  command->add_flag("--antialias", a->look.antialias,
                    "smooth edges in 3D and in the camera picture; rendering takes about 2.5 times as long");
  command->add_flag("--camera", a->look.camera_inset,
                    "show the picture of the followed robot's camera, or of the first robot that has one");
  command->add_option("--from", a->times.from_s, "recordings: start at this time")
      ->type_name("SECONDS")
      ->check(numberIn(0, 1e18));
  command->add_option("--to", a->times.to_s, "recordings: end at this time; also the time of a picture")
      ->type_name("SECONDS")
      ->check(numberIn(0, 1e18));
  command->add_option("--for", a->times.for_s, "videos of live runs: end after this wall time")
      ->type_name("SECONDS")
      ->check(numberIn(0.1, 1e6));
  command->add_option("--speed", a->times.speed, "recordings: recorded seconds per second")
      ->check(numberIn(0.001, 1e6))
      ->default_str("1");
  auto* fps = command->add_option("--fps", a->times.fps, "frames per second of a video")
                  ->check(numberIn(1, 120))
                  ->type_name("NUMBER")
                  ->capture_default_str();
  dependsOn(fps, "--offscreen FILE.mp4 or FILE.webm", [a] { return isVideo(a->offscreen); });
  setGroup(*command, "Views",
           {"--2d", "--3d", "--follow", "--view", "--hide", "--show", "--only", "--size", "--scale", "--antialias",
            "--camera"});
  setGroup(*command, kFigureGroup, {"--offscreen", "--from", "--to", "--for", "--speed", "--fps"});
  CLI::Option* const foxglove = addFoxgloveOptions(
      *command, a->foxglove,
      "no window: serve the topics of ROS 2 to Foxglove and Lichtblick, which play a recording and pause a run "
      "(doc/ros2.md); usually 8765. Uses --tls-cert and --tokens",
      "Foxglove");
  CLI::Option* const web =
      addWebOption(*command, a->web,
                   "no window: show a recording, a world or a running environment on a page in browsers, to up to 256 "
                   "viewers (doc/run_page.md); usually 8081. Uses --tls-cert and --tokens",
                   "Browsers");
  web->excludes(foxglove);
  addListenerOptions(*command, a->listener);
  for (const char* option : {"--tls-cert", "--tls-key", "--tokens", "--listen-unprotected"}) {
    dependsOn(command->get_option(option), {foxglove, web});
  }
  for (const char* option : {"--2d", "--3d", "--follow", "--view", "--hide", "--show", "--only", "--size", "--scale",
                             "--antialias", "--camera", "--offscreen"}) {
    command->get_option(option)->excludes(foxglove)->excludes(web);
  }
  for (const char* option : {"--from", "--to", "--for", "--speed"}) {
    command->get_option(option)->excludes(web);
  }
  addSecurityOptions(*command, a->connection);
  addConnectTimeout(*command, a->connection);
  for (const char* option : {"--tls-ca", "--tls", "--token-file", "--send-token-unencrypted", "--connect-timeout"}) {
    dependsOn(command->get_option(option), "an address as SOURCE", [a] { return !findDataFile(a->source); });
  }
  dependsOn(command->get_option("--seed"), "a world or a map as SOURCE", [a] {
    const auto file = findDataFile(a->source);
    return file && !isRecording(*file);
  });
  Rows keys;
  for (const auto& [key, meaning] : viewKeys()) keys.push_back({"  " + key, meaning});
  command->footer("In the window:\n" + listing(keys) +
                  "Try:  robosim view worlds/opho2_1.xml --offscreen world.png\n"
                  "      robosim view run.rawlog --offscreen figure.pdf --width-mm 88 --font-pt 8");
  command->callback([a] { view(*a); });
}

}  // namespace robosim
