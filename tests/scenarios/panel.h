#pragma once
#include <string>

#include "server/control_panel.h"
#include "tests/scenarios/served_world.h"

namespace robosim {

/// A control panel of the world that the test serves.
class Panel : public ControlPanel {
 public:
  explicit Panel(const ServedWorld& world) : ControlPanel(world.dialOptions()) {}

  using ControlPanel::load;
  /// @param file from the project's folder
  wire::RunStatus load(const std::string& file) { return load(readWorldSource(ROBOSIM_SOURCE_DIR "/" + file)); }
};

}  // namespace robosim
