#pragma once
#include <span>

namespace robosim {

/// GLFW's code of the modifier, which nanogui forwards.
inline constexpr int kControl = 2;

/// A key or mouse action of the window, and its meaning.
struct ViewKey {
  const char* key;
  const char* meaning;
};

/// All of them, for the window's help and for --help.
std::span<const ViewKey> viewKeys();

}  // namespace robosim
