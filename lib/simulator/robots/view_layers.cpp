#include "robots/view_layers.h"

namespace robosim {

std::span<const ViewLayer> viewLayers() {
  static constexpr ViewLayer kLayers[] = {
      {"paths", &ViewLayers::paths, 'T', "Paths", true},       {"starts", &ViewLayers::starts, 0, "", true},
      {"sensors", &ViewLayers::sensors, 'V', "Sensors", true}, {"events", &ViewLayers::events, 'E', "Events", true},
      {"names", &ViewLayers::names, 'N', "Names", true},       {"density", &ViewLayers::density, 'D', "Density", false},
      {"visits", &ViewLayers::visits, 'I', "Visits", false},
  };
  return kLayers;
}

void setShown(ViewLayers& layers, const ViewLayer& layer, bool is_shown) {
  layers.*layer.is_shown = is_shown;
  if (!is_shown) return;
  if (layer.is_shown == &ViewLayers::density) layers.visits = false;
  if (layer.is_shown == &ViewLayers::visits) layers.density = false;
}

}  // namespace robosim
