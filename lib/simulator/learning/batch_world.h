#pragma once
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "environment/model.h"
#include "environment/start_poses.h"
#include "environment/state.h"
#include "learning/batch_options.h"
#include "learning/observation_layout.h"
#include "robots/fleet.h"

namespace robosim {

/// A world of a batch: constant data that all its environments share.
struct BatchWorld {
  std::shared_ptr<const Model> model;
  State start;  ///< before the first measurement
  std::optional<RandomStarts> random_starts;
  std::vector<int> heat_slots;  ///< by agent: measurement of its first heat sensor; -1 for none
};

/// What the agents of all worlds of a batch have in common.
struct BatchAgents {
  std::vector<ObservationLayout> layouts;  ///< by agent
  std::vector<ObservedPicture> pictures;   ///< in the order of BatchOptions::observations
  std::size_t size = 0;                    ///< of the longest observation

  std::size_t count() const { return layouts.size(); }  ///< in each world
};

/// The agents of a batch's first world, which may be of different robot types.
/// @throws ConfigError for a world with too few robots, for ObservationLayout::ofTeam(), and for agents whose pictures
/// of one name differ in form
BatchAgents listAgents(const LoadedWorld& world, const BatchOptions& options);

/// @throws ConfigError for a world whose robots differ from those of the first one in number or in what they observe
std::shared_ptr<const BatchWorld> makeBatchWorld(LoadedWorld world, const BatchOptions& options,
                                                 const BatchAgents& agents);

}  // namespace robosim
