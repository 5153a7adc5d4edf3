#pragma once
#include <optional>
#include <string>

namespace robosim {

/// What gold finders tell each other (2005): that the gold is found, and which robot found it. As text: "GOLD
/// <source>".
struct GoldMessage {
  std::string source;  ///< the finder's name

  std::string text() const;
  /// nullopt for any other text.
  static std::optional<GoldMessage> parse(const std::string& text);
  bool operator==(const GoldMessage&) const = default;
};

}  // namespace robosim
