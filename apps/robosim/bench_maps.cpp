#include <fstream>
#include <iostream>

#include <nlohmann/json.hpp>

#include "base/random.h"
#include "environment/environment.h"
#include "robosim/bench_process.h"
#include "robosim/bench_rounds.h"
#include "robosim/progress.h"
#include "robosim/scratch_folder.h"
#include "robosim/subcommands.h"
#include "robosim/text.h"
#include "robots/fleet.h"

namespace robosim {
namespace {

constexpr std::uint32_t kSide = 2000;  ///< cells along each side of a map
constexpr double kCell_m = 0.05;

/// A map's cells: what stands in each is told by its column, its row and a number in [0, 1) drawn for it.
struct Kind {
  const char* name;
  bool (*stands)(std::uint32_t column, std::uint32_t row, double chance);
};

/// Rooms of 4 m × 4 m, with walls of 15 cm and doors of 1 m.
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

/// Writes a world of one map and one robot, with room for it in the middle.
std::filesystem::path writeWorld(const Kind& kind, const std::filesystem::path& folder) {
  Rng rng(1);
  std::string pixels;
  for (std::uint32_t row = 0; row < kSide; ++row) {
    for (std::uint32_t column = 0; column < kSide; ++column) {
      const bool is_middle = column / 20 == kSide / 40 && row / 20 == kSide / 40;
      pixels += kind.stands(column, row, rng.uniform()) && !is_middle ? '\0' : '\xfe';
    }
  }
  std::ofstream(folder / "map.pgm", std::ios::binary) << "P5 2000 2000 255\n" << pixels;
  std::ofstream(folder / "map.yaml") << "image: map.pgm\nresolution: 0.05\norigin: [0, 0, 0]\nnegate: 0\n"
                                        "occupied_thresh: 0.65\nfree_thresh: 0.196\n";
  std::ofstream(folder / "world.xml") << "<world><surface><map file='map.yaml'/><object><shape><robot>"
                                         "<model>pioneer3dx</model><name>R</name><x>50.5</x><y>50.5</y>"
                                         "</robot></shape></object></surface></world>";
  return folder / "world.xml";
}

/// Loads the world as a run does, up to where its first step can be taken.
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

void benchMaps(bool as_json) {
  const ScratchFolder scratch;
  Rows rows{{"map", "occupied cells", "boxes", "load, CPU [s]", "on the clock [s]", "holds [MB]", "peak [MB]"}};
  auto all = nlohmann::json::array();
  for (const auto& kind : kKinds) {
    nlohmann::json figures;
    {
      Progress progress;
      if (progress.due()) progress.show(std::string("loading ") + kind.name);
      const auto world = writeWorld(kind, scratch.path());
      figures = inOwnProcess([&] { return measure(world); });
    }
    rows.push_back({kind.name, withCommas(figures["occupied"]), withCommas(figures["boxes"]),
                    fixed(figures["load_cpu_s"], 2), fixed(figures["load_wall_s"], 2), fixed(figures["held_mb"], 0),
                    fixed(figures["peak_mb"], 0)});
    figures["map"] = kind.name;
    all.push_back(figures);
  }
  if (as_json) {
    std::cout << all.dump(2) << '\n';
  } else {
    std::cout << table(rows) << "Maps of " << withCommas(kSide) << " × " << withCommas(kSide) << " cells of "
              << fixed(kCell_m, 2) << " m, each loaded in a process of its own, up to where a run can take its first "
              << "step.\n";
  }
}

}  // namespace

void addBenchMaps(CLI::App& bench) {
  auto* command = bench.add_subcommand("maps", "How long large maps take to load, and how much memory they take");
  auto as_json = std::make_shared<bool>(false);
  command->add_flag("--json", *as_json, "print a JSON array, an object for each map");
  command->callback([as_json] { benchMaps(*as_json); });
}

}  // namespace robosim
