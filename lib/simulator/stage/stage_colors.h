#pragma once
#include <array>
#include <optional>
#include <string>

namespace robosim::stage {

/// Red, green, blue, each in [0, 1], of a colour by its X11 name, in any case and with or without blanks: "red",
/// "gray50", "NavyBlue", "navy blue". nullopt for an unknown name. Values: X.Org's rgb.txt.
std::optional<std::array<float, 3>> colorNamed(const std::string& name);

}  // namespace robosim::stage
