#pragma once
#include <cstddef>
#include <optional>
#include <string>

#include "environment/environment.h"
#include "robots/start_places.h"

namespace robosim {

/// Adds robots of a type to a run, each at a random free place, when ARCOS programs need them. Names and places follow
/// from the run's seed and the order of the robots.
class ArcosFactory {
 public:
  /// @param environment must outlive this @param type of a robot of the run @param most robots that are added
  ArcosFactory(Environment& environment, std::string type, std::size_t most);

  /// Whether fewer have been added than may be.
  bool mayAdd() const { return added_ < most_; }
  /// Adds a robot, as an intervention. @return its index; nullopt when there is no free place, or there are as many as
  /// there may be
  std::optional<std::size_t> add();

 private:
  bool isClearOfRobots(const mrpt::math::TPoint2D& place) const;
  std::string newName() const;

  Environment& environment_;
  const std::string type_;
  const std::size_t most_;
  std::size_t added_ = 0;
  std::optional<FreePlaces> places_;  ///< nullopt until it is needed
  double radius_m_ = 0;               ///< of a robot of the type
};

}  // namespace robosim
