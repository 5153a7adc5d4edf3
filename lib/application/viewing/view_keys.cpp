#include "viewing/view_keys.h"

namespace robosim {

std::span<const ViewKey> viewKeys() {
  static constexpr ViewKey kKeys[] = {
      {"left drag", "move (2D), turn (3D)"},
      {"right drag", "move (3D)"},
      {"wheel", "zoom"},
      {"Ctrl left drag", "move a robot or an object of a run"},
      {"Ctrl right drag", "turn it towards the mouse"},
      {"u, Ctrl z", "undo the last of these moves"},
      {"click", "follow a robot, or none"},
      {"space", "pause, resume"},
      {"s", "one step"},
      {"+  -", "faster, slower"},
      {"Left, Right", "5 s back or on, of a recording"},
      {"f", "follow the next robot"},
      {"0", "show everything"},
      {"t", "paths"},
      {"v", "sensors"},
      {"n", "names"},
      {"c", "camera picture"},
      {"F11", "full screen, window"},
      {"?", "this help"},
      {"q, Esc", "quit"},
  };
  return kKeys;
}

}  // namespace robosim
