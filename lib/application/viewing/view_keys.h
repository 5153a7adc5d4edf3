#pragma once
#include <span>
#include <string>

namespace robosim {

/// GLFW's code of the modifier, which nanogui forwards.
inline constexpr int kControl = 2;

/// A key or mouse action of the window, and its meaning.
struct ViewKey {
  std::string key;
  std::string meaning;
};

/// All of them, with those of the layers (viewLayers()), for the window's help and for --help.
std::span<const ViewKey> viewKeys();

}  // namespace robosim
