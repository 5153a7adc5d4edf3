#pragma once
#include <string>

#include "environment/world_changes.h"

namespace robosim {

/// Under which circumstances robots search. As text: "ideal", or one or more of "noise" or "errors", "loss=0.3" and
/// "breakdown_s=300", separated by '+'.
struct Condition {
  AddedNoise noise = AddedNoise::none;  ///< of sensors without: "noise" is typical, "errors" is all
  double message_loss = 0;              ///< probability that a message is lost, [0, 1]; 0: that of the world
  double breakdown_mean_s = 0;          ///< RunOptions::breakdown_mean_s, [1, 1e9]; 0: no robot breaks down
  bool operator==(const Condition&) const = default;

  /// @throws ConfigError
  static Condition parse(const std::string& text);
  std::string text() const;
};

}  // namespace robosim
