#pragma once
#include <cstddef>
#include <vector>

#include "hardware/sensor_info.h"

namespace robosim {

/// The quantities of a range-and-bearing sensor of SensorKind::values: for neighbour i = 1 … count `robot_i` (index in
/// the world; -1: none), `range_i` [m], `bearing_i` [rad].
inline std::vector<Quantity> neighbourQuantities(std::size_t count) {
  std::vector<Quantity> quantities;
  for (std::size_t i = 1; i <= count; ++i) {
    const std::string number = std::to_string(i);
    quantities.push_back({"robot_" + number, ""});
    quantities.push_back({"range_" + number, "m"});
    quantities.push_back({"bearing_" + number, "rad"});
  }
  return quantities;
}

}  // namespace robosim
