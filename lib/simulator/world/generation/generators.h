#pragma once
#include "world/generation/scenery.h"

namespace robosim {

/// @name Random scenery
/// Every generator depends only on its arguments: equal seeds give equal worlds on any processor.
/// @throws ConfigError for options out of bounds, and for more than 20,000,000 places
///@{

/// Square cells between thin walls: all cells are connected.
struct MazeOptions {
  int columns = 20, rows = 20;  ///< 2 to 1000
  double braid = 0.1;   ///< fraction of dead ends that get a second opening: 0 a perfect maze, 1 without dead ends
  double cell_m = 1.5;  ///< distance between the centres of cells, 1 to 100
};
Scenery generateMaze(const MazeOptions&, std::uint64_t seed);

/// Caverns with ragged rims, by a cellular automaton: a cell becomes rock if at least five of the nine cells around and
/// including it are rock, five times from random cells.
struct CaveOptions {
  double width_m = 30, length_m = 30;  ///< 5 to 1000
  double rock = 0.42;                  ///< initial fraction of rock, 0 to 0.6
};
Scenery generateCave(const CaveOptions&, std::uint64_t seed);

/// Rooms with doors on both sides of a corridor.
struct OfficeOptions {
  double width_m = 30, length_m = 20;  ///< 10 to 1000; the corridor runs along the width
  double room_m = 4;                   ///< minimum side of a room, 2 to 100
};
Scenery generateOffice(const OfficeOptions&, std::uint64_t seed);

/// A walled area with boxes and pillars of random size and direction that do not touch.
struct OpenOptions {
  double width_m = 30, length_m = 30;  ///< 5 to 1000
  double clutter = 0.1;                ///< obstacles per square metre, 0 to 1; fewer if they do not fit
};
Scenery generateOpen(const OpenOptions&, std::uint64_t seed);
///@}

}  // namespace robosim
