#pragma once
#include <string>
#include <utility>
#include <vector>

namespace robosim {

/// A type of controller or observer with values for its parameters. As text, on the command line, in recordings and
/// over the network: "flocking cohesion=0.3 radius_m=2". In a world file: <controller name="flocking" cohesion="0.3"
/// radius_m="2"/>.
struct TypeChoice {
  std::string name;
  std::vector<std::pair<std::string, std::string>> parameters;  ///< names and values as written, not yet checked

  /// @param kind for errors: "controller", "observer"
  /// @throws ConfigError for a text without a name, or with a word after it that is not PARAMETER=VALUE
  static TypeChoice parse(const std::string& text, const std::string& kind = "controller");
  std::string text() const;
  bool operator==(const TypeChoice&) const = default;
};

}  // namespace robosim
