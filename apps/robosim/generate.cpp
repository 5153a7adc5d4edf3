#include <functional>
#include <iostream>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>

#include "base/atomic_file.h"
#include "base/error_list.h"
#include "base/nearest_name.h"
#include "base/printable_text.h"
#include "base/text_table.h"
#include "base/xml_element.h"
#include "robosim/arguments.h"
#include "robosim/subcommands.h"
#include "robots/fleet.h"
#include "run/local_run.h"
#include "world/generation/generators.h"
#include "world/world_file.h"

namespace robosim {
namespace {

struct GenerateArguments {
  std::string out = "-";
  std::uint64_t seed = 1;
  TeamOptions team;
  bool without_gold = false;
  MazeOptions maze;
  CaveOptions cave;
  OfficeOptions office;
  OpenOptions open;
};

/// Kind and options as given, as a comment, in which "--" must not occur.
std::string makeComment(const CLI::App& kind) {
  std::string text = "<!-- Made by robosim generate " + kind.get_name();
  for (const CLI::Option* option : kind.get_options()) {
    if (option->count() == 0 || !option->nonpositional()) continue;
    text += ", " + option->get_name().substr(2);
    if (option->get_items_expected_max() == 0) continue;
    for (const auto& value : option->results()) text += " " + value;
  }
  for (auto at = text.find("--", 5); at != std::string::npos; at = text.find("--", at)) text.replace(at, 2, "-");
  return text + " -->\n";
}

/// Reports an unknown type once, rather than at each robot.
void requireTypes(const std::vector<std::string>& models, const std::string& file) {
  const RobotTypes types = robotTypesIn(robotTypeFolders(file));
  std::vector<std::string> known;
  for (const auto& [name, type] : types) known.push_back(name);
  for (const auto& model : models) {
    if (types.contains(model)) continue;
    throw ConfigError("--types " + model + ": there is no robot type '" + quotable(model) + "'" +
                      didYouMean(model, known) + "; known are: " + listed(known));
  }
}

void generate(const GenerateArguments& arguments, const Scenery& scenery, const std::string& comment) {
  requireTypes(arguments.team.models, arguments.out == "-" ? "world.xml" : arguments.out);
  World world = populated(scenery, arguments.team, arguments.seed);
  const std::string file = arguments.out == "-" ? "world.xml" : arguments.out;
  ErrorList errors;
  buildFleet(world, file, robotTypesIn(robotTypeFolders(file)), checkController, errors);
  errors.throwIfAny();
  std::string text = toXml(world);
  text.insert(text.find('\n') + 1, comment);
  if (arguments.out == "-") {
    std::cout << text;
    return;
  }
  AtomicFile written(arguments.out);
  written.write(text);
  written.finish();
  written.commit();
  std::cout << printableText(arguments.out) << ": " << withCommas(world.objects.size()) << " objects, "
            << withCommas(world.robots.size()) << " robots\n";
}

using Make = std::function<Scenery(const GenerateArguments&)>;

/// Adds a kind with the options that all kinds have.
CLI::App& addKind(CLI::App& command, const std::shared_ptr<GenerateArguments>& a, const char* name, const char* help,
                  const Make& make) {
  CLI::App& kind = *command.add_subcommand(name, help);
  kind.add_option("OUT", a->out, "world file to write; - for standard output")
      ->type_name("FILE")
      ->check(fileName())
      ->capture_default_str();
  kind.add_option("--seed", a->seed, "seed of the world; equal seeds give equal files")
      ->check(seedNumber())
      ->type_name("NUMBER")
      ->capture_default_str();
  kind.add_option("--robots", a->team.robots, "number of robots, far from each other")
      ->check(wholeNumberIn(0, 10'000))
      ->type_name("NUMBER")
      ->capture_default_str();
  kind.add_option("--types", a->team.models, "robot types, used in turn")
      ->delimiter(',')
      ->type_name("TYPE,…")
      ->capture_default_str();
  addControllerOption(kind, a->team.controller, "controller of all robots");
  kind.add_flag("--no-gold", a->without_gold, "without gold, which otherwise lies far from all robots");
  kind.callback([a, make, &kind] {
    a->team.has_gold = !a->without_gold;
    generate(*a, make(*a), makeComment(kind));
  });
  return kind;
}

CLI::Option* addNumber(CLI::App& kind, const std::string& name, double& value, const std::string& help, double min,
                       double max, const char* unit) {
  return kind.add_option(name, value, help)->check(numberIn(min, max))->type_name(unit)->capture_default_str();
}

void addSize(CLI::App& kind, double& width_m, double& length_m, double min_m) {
  addNumber(kind, "--width", width_m, "extent in x", min_m, 1000, "METRES");
  addNumber(kind, "--length", length_m, "extent in y", min_m, 1000, "METRES");
}

}  // namespace

void addGenerate(CLI::App& program) {
  auto* command = addSubcommand(program, "generate");
  command->require_subcommand(1);
  auto a = std::make_shared<GenerateArguments>();

  auto& maze = addKind(*command, a, "maze", "Square cells between thin walls; all are connected",
                       [](const GenerateArguments& it) { return generateMaze(it.maze, it.seed); });
  for (auto [name, count] : {std::pair{"--columns", &a->maze.columns}, std::pair{"--rows", &a->maze.rows}}) {
    maze.add_option(name, *count, "number of cells")
        ->check(wholeNumberIn(2, 1000))
        ->type_name("NUMBER")
        ->capture_default_str();
  }
  addNumber(maze, "--braid", a->maze.braid, "fraction of dead ends that get a second opening: 0 a perfect maze", 0, 1,
            "NUMBER");
  addNumber(maze, "--cell", a->maze.cell_m, "distance between the centres of cells", 1, 100, "METRES");

  auto& cave = addKind(*command, a, "cave", "Caverns with ragged rims",
                       [](const GenerateArguments& it) { return generateCave(it.cave, it.seed); });
  addSize(cave, a->cave.width_m, a->cave.length_m, 5);
  addNumber(cave, "--rock", a->cave.rock, "fraction of rock before smoothing; more gives narrower caverns", 0, 0.6,
            "NUMBER");

  auto& office = addKind(*command, a, "office", "Rooms with doors on both sides of a corridor",
                         [](const GenerateArguments& it) { return generateOffice(it.office, it.seed); });
  addSize(office, a->office.width_m, a->office.length_m, 10);
  addNumber(office, "--room", a->office.room_m, "minimum side of a room", 2, 100, "METRES");

  auto& open = addKind(*command, a, "open", "A walled area with boxes and pillars",
                       [](const GenerateArguments& it) { return generateOpen(it.open, it.seed); });
  addSize(open, a->open.width_m, a->open.length_m, 5);
  addNumber(open, "--clutter", a->open.clutter, "obstacles per square metre; fewer if they do not fit", 0, 1, "NUMBER");

  command->footer(
      "Try:  robosim generate maze maze.xml --columns 10 --rows 10 --seed 7 && robosim run maze.xml\n"
      "      robosim generate cave cave.xml --robots 20 && robosim export cave.xml cave.svg");
}

}  // namespace robosim
