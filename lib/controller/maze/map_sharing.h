#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "maze/explorer.h"
#include "maze/grid.h"

namespace robosim {

/// A square of 8 × 8 map cells: bit 8·row + column, from the lower left.
struct MapTile {
  static constexpr int kSide = 8;

  Cell tile;  ///< cell (0, 0) of tile (x, y) is the map's cell (8x, 8y)
  std::uint64_t searched = 0;
  std::uint64_t occupied = 0;
  bool operator==(const MapTile&) const = default;
};

/// Message between robots with a common frame: parts of the sender's map. As text: "MAP <cell side in µm>", then
/// " <x>,<y>,<searched>,<occupied>" for each tile, the last two hexadecimal.
struct MapMessage {
  static constexpr std::size_t kMaxTiles = 64;  ///< whose text is shorter than kMaxMessageBytes

  std::int64_t cell_um = 0;
  std::vector<MapTile> tiles;

  std::string text() const;
  /// nullopt for any other text.
  static std::optional<MapMessage> parse(const std::string& text);
};

/// Shares the maps of a team by messages: cells that have been searched or are certainly occupied, once each. It sends
/// at most one message of MapMessage::kMaxTiles tiles at a time, and what is left in the next.
class MapSharing {
 public:
  /// The next cells of a map that have not been sent or received; nullopt without any.
  std::optional<MapMessage> next(const MazeMap& map);
  /// Enters the cells of a message into the map; of a robot with another size of cells, into those that they cover.
  void receive(const MapMessage& message, SearchMap& search);

 private:
  /// What all robots know of a tile.
  struct Known {
    std::uint64_t searched = 0, occupied = 0;
  };
  std::optional<Grid<Known>> known_;  ///< by tile
  std::size_t next_tile_ = 0;         ///< index in the map's tiles, row by row, where the search continues
};

}  // namespace robosim
