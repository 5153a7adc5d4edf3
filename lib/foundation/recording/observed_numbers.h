#pragma once
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <mrpt/obs/CObservation.h>

#include "hardware/field.h"

namespace robosim {

/// A number of an observation.
struct ObservedNumber {
  std::string name;                  ///< without unit and index: "range"
  std::optional<std::size_t> index;  ///< in a list of equal records
  Unit unit;
  std::variant<std::monostate, float, double> value;  ///< none: nothing was measured, such as an absent echo
  bool has_gaps = false;                              ///< the list may lack records, so that texts show the index

  /// Name with index and unit, such as "range_3_m".
  std::string fullName() const;
};

/// Degrees of latitude and longitude.
inline constexpr Unit kDegree{"deg", "°"};

using ObservedNumbers = std::vector<ObservedNumber>;

/// The numbers of an observation of a class that a Codec records, of RoboSim or another program, and of GPS receivers'
/// NMEA messages GGA and RMC; nullopt for others.
std::optional<ObservedNumbers> numbersIn(const mrpt::obs::CObservation& observation);

}  // namespace robosim
