#include <fstream>
#include <iostream>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "base/interrupt.h"
#include "base/progress.h"
#include "base/random.h"
#include "base/temporary_directory.h"
#include "base/text_table.h"
#include "environment/environment.h"
#include "robosim/arguments.h"
#include "robosim_bench/benchmarks.h"
#include "robosim_bench/process.h"
#include "robosim_bench/rounds.h"
#include "robots/fleet.h"

namespace robosim {
namespace {

constexpr double kCell_m = 0.05;
constexpr std::uint32_t kRoom = 20;  ///< side of the free square around the robot, in cells

/// Fills a map's cells; each cell is a function of its column, its row and a random number in [0, 1).
struct Kind {
  const char* name;
  bool (*is_occupied)(std::uint32_t column, std::uint32_t row, double chance);
};

/// An indoor map: rooms of 4 m × 4 m, with walls of 15 cm and doors of 1 m.
bool isRoomWall(std::uint32_t column, std::uint32_t row, double /*chance*/) {
  const std::uint32_t x = column % 80, y = row % 80;
  return (x < 3 && (y < 30 || y >= 50)) || (y < 3 && (x < 30 || x >= 50));
}

constexpr Kind kKinds[] = {
    {"rooms", isRoomWall},
    {"noise 1 %", [](std::uint32_t, std::uint32_t, double chance) { return chance < 0.01; }},
    {"noise 10 %", [](std::uint32_t, std::uint32_t, double chance) { return chance < 0.1; }},
    {"noise 50 %", [](std::uint32_t, std::uint32_t, double chance) { return chance < 0.5; }},
    {"chequered", [](std::uint32_t column, std::uint32_t row, double) { return (column + row) % 2 == 1; }},
};

/// Writes a world of one map of `side` × `side` cells and one robot in a free square in its middle.
std::filesystem::path writeWorld(const Kind& kind, std::uint32_t side, const std::filesystem::path& folder) {
  Rng rng(1);
  std::string pixels;
  const auto is_middle = [side](std::uint32_t at) { return at + kRoom / 2 >= side / 2 && at < side / 2 + kRoom / 2; };
  for (std::uint32_t row = 0; row < side; ++row) {
    for (std::uint32_t column = 0; column < side; ++column) {
      const bool is_occupied = kind.is_occupied(column, row, rng.uniform());
      pixels += is_occupied && !(is_middle(column) && is_middle(row)) ? '\0' : '\xfe';
    }
  }
  const std::string cells = std::to_string(side), middle_m = toText(side / 2 * kCell_m);
  std::ofstream(folder / "map.pgm", std::ios::binary) << "P5 " + cells + " " + cells + " 255\n" << pixels;
  std::ofstream(folder / "map.yaml") << "image: map.pgm\nresolution: 0.05\norigin: [0, 0, 0]\nnegate: 0\n"
                                        "occupied_thresh: 0.65\nfree_thresh: 0.196\n";
  std::ofstream(folder / "world.xml") << "<world><surface><map file='map.yaml'/><object><shape><robot>"
                                         "<model>pioneer3dx</model><name>R</name><x>" +
                                             middle_m + "</x><y>" + middle_m +
                                             "</y></robot></shape></object></surface></world>";
  return folder / "world.xml";
}

/// Loads the world as a run does, up to its first step.
nlohmann::json measure(const std::filesystem::path& world) {
  const Memory before = Memory::now();
  const Clocks start = Clocks::now();
  LoadedWorld loaded = loadWorld(world, {});
  const FloorPlan plan = loaded.world.maps.at(0).plan;
  const Environment environment(std::move(loaded.world), std::move(loaded.fleet), EnvironmentOptions{});
  const Clocks end = Clocks::now();
  return {{"occupied", plan.occupiedCells()},
          {"boxes", plan.occupied.size()},
          {"load_cpu_s", end.cpu_s - start.cpu_s},
          {"load_wall_s", end.wall_s - start.wall_s},
          {"held_mb", Memory::now().resident_mb - before.resident_mb},
          {"peak_mb", Memory::now().peak_mb}};
}

struct MapsArguments {
  std::uint32_t side = 2000;
  bool as_json = false;
};

void benchMaps(const MapsArguments& arguments) {
  const Interrupt interrupt;  // ends the measuring process; this one then removes its files
  const TemporaryDirectory scratch;
  Rows rows{{"map", "occupied cells", "boxes", "load, CPU [s]", "wall time [s]", "resident [MB]", "peak [MB]"}};
  auto all = nlohmann::json::array();
  for (const auto& kind : kKinds) {
    nlohmann::json figures;
    {
      Progress progress;
      if (progress.due()) progress.show(std::string("loading ") + kind.name);
      const auto world = writeWorld(kind, arguments.side, scratch.path());
      if (interrupt.isRequested()) throw Interrupted(kInterrupted);
      figures = runInChildProcess([&] { return measure(world); });
    }
    rows.push_back({kind.name, withCommas(figures["occupied"]), withCommas(figures["boxes"]),
                    fixed(figures["load_cpu_s"], 2), fixed(figures["load_wall_s"], 2), fixed(figures["held_mb"], 0),
                    fixed(figures["peak_mb"], 0)});
    figures["map"] = kind.name;
    all.push_back(figures);
  }
  if (arguments.as_json) {
    std::cout << all.dump(2) << '\n';
  } else {
    std::cout << table(rows) << "Maps of " << withCommas(arguments.side) << " × " << withCommas(arguments.side)
              << " cells of " << fixed(kCell_m, 2)
              << " m, each loaded in a separate process, up to where a run can take its first "
              << "step.\n";
  }
}

}  // namespace

void addMapsBenchmark(CLI::App& program) {
  auto* command = program.add_subcommand("maps", "Measure load times and memory of large maps");
  auto a = std::make_shared<MapsArguments>();
  command->add_option("--side", a->side, "cells along each side of a map, of 0.05 m; 100 to 8000")
      ->check(wholeNumberIn(100, 8000))
      ->type_name("NUMBER")
      ->capture_default_str();
  command->add_flag("--json", a->as_json, "print a JSON array with an object for each map");
  command->callback([a] { benchMaps(*a); });
}

}  // namespace robosim
