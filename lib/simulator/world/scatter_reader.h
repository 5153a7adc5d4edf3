#pragma once
#include <vector>

#include "base/xml_reader.h"
#include "world/placement_reader.h"
#include "world/world.h"

namespace robosim {

/// Reads the <scatter> elements of a world into World::scatters.
class ScatterReader {
 public:
  /// Both must outlive this object. @param placements reads what is copied, and contains the names of the world
  ScatterReader(World& world, PlacementReader& placements) : world_(world), placements_(placements) {}

  void read(XmlReader& reader);
  /// Checks the number of copies, and that their names are free. Comes after all other names, so that a conflict is
  /// reported at the <scatter>.
  void checkNames();

 private:
  void readArea(XmlReader& reader, Scatter& scatter);

  World& world_;
  PlacementReader& placements_;
  std::vector<XmlReader> readers_;  ///< of World::scatters
};

}  // namespace robosim
