#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace robosim {

/// What a view or figure shows besides world and robots. With many robots in the picture, DetailLevel leaves some of it
/// out.
struct ViewLayers {
  bool paths = true;
  bool starts = true;   ///< rings at the beginnings of the drawn paths, in figures
  bool sensors = true;  ///< of robots that have readings: sonar fans, laser scans, infrared, heat, bumper
  bool names = true;
  bool events = true;                ///< stalls and found gold; in figures also messages
  bool density = false;              ///< robots per area (DensityMap)
  bool visits = false;               ///< visits per area; not together with `density`
  double paths_from_s = 0;           ///< earlier parts of the paths are not drawn, nor are earlier events and visits
  std::vector<std::uint8_t> only{};  ///< flags of the shown robots; empty: all

  bool shows(std::size_t robot) const { return only.empty() || (robot < only.size() && only[robot] != 0); }
};

/// A layer that is switched by its name (--hide, --show), or by a key of the window.
struct ViewLayer {
  const char* name;
  bool ViewLayers::*is_shown;
  char key;             ///< upper case; 0 for a layer that only figures have
  const char* label;    ///< of its button
  bool is_shown_first;  ///< without an option
};

/// All layers. To add one, add a line to this list, and draw it.
std::span<const ViewLayer> viewLayers();

/// Switches a layer; of layers that exclude each other, the other one is then off.
void setShown(ViewLayers& layers, const ViewLayer& layer, bool is_shown);

}  // namespace robosim
