#include "robots/fleet.h"
#include "run/local_run.h"
#include "run/output_files.h"
#include "viewing/view_source.h"
#include "world/world_file.h"

namespace robosim {
namespace {

class WorldView final : public ViewSource {
 public:
  WorldView(const std::string& file, LoadedWorld world, std::uint64_t seed = 1)
      : title_(file), world_(std::move(world)) {
    // An environment measures the readings at the start poses.
    snapshot_ = takeSnapshot(Environment(world_.world, world_.fleet, {.seed = seed}));
  }

  const LoadedWorld& world() const override { return world_; }
  const RunSnapshot& snapshot() const override { return snapshot_; }
  const RunPaths& paths() const override { return paths_; }
  std::vector<std::filesystem::path> inputs() const override { return listInputFiles(title_, world_.world); }
  std::string title() const override { return title_; }
  bool advance(double) override { return false; }
  bool isOver() const override { return true; }

 private:
  std::string title_;
  LoadedWorld world_;
  RunSnapshot snapshot_;
  RunPaths paths_;  ///< none
};

}  // namespace

RunSnapshot takeSnapshot(const Environment& environment) {
  const State& state = environment.state();
  RunSnapshot snapshot{state.time.step, state.time.seconds(), {}, state.objects};
  for (std::size_t i = 0; i < environment.robotCount(); ++i) {
    snapshot.robots.push_back({state.world_from_robot[i], state.laser_pan_rad[i], state.stalled[i] != 0,
                               state.activity[i], state.readings[i], state.commands[i].led_color});
  }
  return snapshot;
}

std::unique_ptr<ViewSource> viewWorld(const std::string& file, const WorldChanges& changes, std::uint64_t seed) {
  return std::make_unique<WorldView>(file, changedWorld(file, changes, checkController, seed), seed);
}

std::unique_ptr<ViewSource> viewWorld(const std::string& file, std::string text, std::uint64_t seed) {
  ErrorList errors;
  World world = parseWorld(std::move(text), file, filesOnDisk(file), errors);
  LoadedWorld loaded =
      placedWorld(std::move(world), file, robotTypesIn(robotTypeFolders(file)), checkController, seed, errors);
  errors.throwIfAny();
  return std::make_unique<WorldView>(file, std::move(loaded), seed);
}

}  // namespace robosim
