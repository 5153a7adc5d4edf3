#pragma once
#include <optional>
#include <string>

namespace robosim {

/// Message between gold finders (2005): the gold has been found, and by which robot. As text: "GOLD <source>".
struct GoldMessage {
  std::string source;  ///< the finder's name

  std::string text() const;
  /// nullopt for any other text.
  static std::optional<GoldMessage> parse(const std::string& text);
  bool operator==(const GoldMessage&) const = default;
};

}  // namespace robosim
