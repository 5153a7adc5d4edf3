#include "learning/world_generator.h"

#include <utility>

#include "base/error_list.h"
#include "robots/robot_types.h"

namespace robosim {
namespace {

World worldOf(const WorldGenerator::MakeScenery& make, const TeamOptions& team, const std::string& name,
              std::uint64_t seed) {
  World world = populated(make(seed), team, seed);
  world.name = name;
  return world;
}

}  // namespace

WorldGenerator::WorldGenerator(MakeScenery make, TeamOptions team, std::string name)
    : make_(std::move(make)), team_(std::move(team)), name_(std::move(name)) {
  const std::string file = name_ + ".xml";
  ErrorList errors;
  alike_ = buildFleet(worldOf(make_, team_, name_, 1), file, robotTypesIn(robotTypeFolders(file)), {}, errors);
  errors.throwIfAny();
}

LoadedWorld WorldGenerator::operator()(std::uint64_t seed) const {
  LoadedWorld made{worldOf(make_, team_, name_, seed), {}};
  ErrorList errors;
  made.fleet = buildFleet(made.world, name_ + ".xml", alike_, errors);
  errors.throwIfAny();
  return made;
}

}  // namespace robosim
