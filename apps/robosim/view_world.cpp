#include "maze/controllers.h"
#include "robosim/view_source.h"
#include "robots/fleet.h"

namespace robosim {
namespace {

class WorldView final : public ViewSource {
 public:
  explicit WorldView(const std::string& file) : title_(file), world_(loadWorld(file, controllerNames())) {
    // An environment senses what robots sense at their start.
    shown_ = shownOf(Environment(world_.world, world_.fleet, {}));
  }

  const LoadedWorld& world() const override { return world_; }
  const Shown& shown() const override { return shown_; }
  std::string title() const override { return title_; }
  bool advance(double) override { return false; }
  bool isOver() const override { return true; }

 private:
  std::string title_;
  LoadedWorld world_;
  Shown shown_;
};

}  // namespace

Shown shownOf(const Environment& environment) {
  const State& state = environment.state();
  Shown shown{state.time.step, state.time.seconds(), {}};
  for (std::size_t i = 0; i < environment.robotCount(); ++i) {
    shown.robots.push_back({state.world_from_robot[i], state.laser_pan_rad[i], state.stalled[i] != 0, state.activity[i],
                            state.readings[i]});
  }
  return shown;
}

std::unique_ptr<ViewSource> viewWorld(const std::string& file) { return std::make_unique<WorldView>(file); }

}  // namespace robosim
