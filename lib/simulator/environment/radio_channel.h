#pragma once
#include <cstdint>

#include <mrpt/math/TPoint3D.h>

#include "base/sim_time.h"
#include "geometry/scene.h"
#include "world/world.h"

namespace robosim {

/// Why a message does not arrive.
enum class MessageFate { arrives, out_of_range, stopped_by_walls, lost_by_chance, lost_in_burst };

/// The radio channels between the robots. Each pair of robots has a channel of two states (Gilbert, "Capacity of a
/// burst-noise channel", Bell System Technical Journal 39, 1960; Elliott, "Estimates of error rates for codes on
/// burst-noise channels", ibid. 42, 1963): good, in which messages are lost with Communication::loss_probability, and
/// bad, with burst_loss. In each step a channel in the good state becomes bad with the probability p = T / burst_gap_s,
/// one in the bad state good with r = T / burst_s; where p + r > 1, both are scaled to that sum, and the states of
/// successive steps are independent.
///
/// The states need no memory: a random number below p makes a channel bad, another r of the range makes it good, both
/// whatever its state, and the rest leaves it. Its state is that of the latest number below p + r, and that of a
/// stationary channel at the start. Channels are the same in both directions. Omitted: collisions, and attenuation that
/// depends on the material.
class RadioChannel {
 public:
  /// Number of robots of a scene whose moving solids are all robots.
  static constexpr std::size_t kAllMoving = ~std::size_t{0};

  /// @param communication must outlive this object
  /// @param robots the first moving solids of scenes, which are no walls; those after them are objects
  explicit RadioChannel(const Communication& communication, std::size_t robots = kAllMoving)
      : communication_(communication), robots_(robots) {}

  /// Replaces the number of robots.
  void setRobots(std::size_t robots) { robots_ = robots; }

  /// A message between two robots.
  struct Way {
    std::uint32_t from = 0, to = 0;
    std::size_t index = 0;                          ///< of the message among those of its sender in this step
    mrpt::math::TPoint3D from_antenna, to_antenna;  ///< world frame
  };
  MessageFate decideFate(std::uint64_t seed, const SimTime& now, const Scene& scene, const Way& way) const;
  /// Whether the channel of two robots is in the bad state.
  bool isBad(std::uint64_t seed, const SimTime& now, std::uint32_t a, std::uint32_t b) const;
  /// Number of walls between two points: connected parts of the line between them that walls and objects occupy. Solids
  /// that touch, such as the rectangles of a map's wall, are one wall.
  static int wallsBetween(const Scene&, const mrpt::math::TPoint3D& a, const mrpt::math::TPoint3D& b,
                          std::size_t robots = kAllMoving);

 private:
  const Communication& communication_;
  std::size_t robots_;
};

/// Number of whole steps by which messages are delayed beyond the next step.
std::uint64_t delaySteps(const Communication&, double period_s);
/// Number of messages that a robot may send in a step. A rate below that of the steps lets one pass every few steps.
std::uint64_t messagesAllowed(const Communication&, const SimTime& now);

}  // namespace robosim
