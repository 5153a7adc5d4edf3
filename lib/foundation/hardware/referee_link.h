#pragma once

namespace robosim {

/// Connection of a robot to the referee that decides whether it has won (2005: CheckWin). Robots of a simulated world
/// have one, in this process or over the network; a real robot has none.
class RefereeLink {
 public:
  virtual ~RefereeLink() = default;
  /// Requests, with the next time step, a check whether this robot has won. The result is in Readings::winner and
  /// `is_too_far`.
  virtual void checkWin() = 0;
};

}  // namespace robosim
