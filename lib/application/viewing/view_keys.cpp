#include "viewing/view_keys.h"

#include <algorithm>
#include <vector>

#include "robots/view_layers.h"

namespace robosim {
namespace {

const std::vector<ViewKey> kActions = {
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
    {"c", "camera picture"},
    {"F11", "full screen, window"},
    {"?", "this help"},
    {"q, Esc", "quit"},
};

}  // namespace

std::span<const ViewKey> viewKeys() {
  static const std::vector<ViewKey> keys = [] {
    std::vector<ViewKey> all = kActions;
    const auto camera = std::find_if(all.begin(), all.end(), [](const ViewKey& key) { return key.key == "c"; });
    std::vector<ViewKey> layers;
    for (const ViewLayer& layer : viewLayers()) {
      if (layer.key != 0) layers.push_back({std::string(1, static_cast<char>(layer.key - 'A' + 'a')), layer.name});
    }
    all.insert(camera, layers.begin(), layers.end());
    return all;
  }();
  return keys;
}

}  // namespace robosim
