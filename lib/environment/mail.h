#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <mrpt/math/TPose2D.h>

#include "base/sim_time.h"
#include "hardware/readings.h"
#include "world/world.h"

namespace robosim {

/// Carries messages between the robots of a world: what is sent in one step arrives in the next.
class Mail {
 public:
  Mail(std::vector<std::string> names, const Communication& communication, std::uint64_t seed);

  /// Different senders may send from different threads.
  /// @throws std::invalid_argument for an unknown receiver or too long a text.
  void send(std::size_t from, const std::string& to, const std::string& text);

  /// Replaces every robot's inbox by what was sent to it since the last call, by sender and then as sent. Messages to a
  /// robot out of range now, or drawn for loss, are gone.
  /// @return how many arrived
  std::size_t deliver(SimTime now, std::span<const mrpt::math::TPose2D> world_from_robot, std::span<Readings> readings);

 private:
  struct Letter {
    std::size_t to;
    std::string text;
  };
  bool arrives(SimTime now, std::size_t from, std::size_t index, std::size_t to,
               std::span<const mrpt::math::TPose2D> world_from_robot) const;

  std::vector<std::string> names_;
  std::vector<std::uint32_t> by_name_;  ///< robots, sorted by their names
  Communication communication_;
  std::uint64_t seed_;
  std::vector<std::vector<Letter>> sent_by_;
  std::vector<std::size_t> filled_inboxes_;  ///< to be emptied in the next step
};

}  // namespace robosim
