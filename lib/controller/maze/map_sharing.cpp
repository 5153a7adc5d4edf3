#include "maze/map_sharing.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace robosim {
namespace {

const std::string kMap = "MAP ";
constexpr int kSureEvidence = 8;  // of a shared obstacle: several echoes
constexpr int kFarthest = 1'000'000;
constexpr std::int64_t kCellMax_um = 10'000'000;

int floorDiv(int a, int b) { return a >= 0 ? a / b : -((b - 1 - a) / b); }

void appendHex(std::uint64_t bits, std::string& text) {
  char digits[16];
  const auto end = std::to_chars(std::begin(digits), std::end(digits), bits, 16).ptr;
  text.append(std::begin(digits), end);
}

/// Reads a number that ends at `stop`, or at the end of the text for '\0'. @return whether there is one
template <typename Number>
bool read(const char*& at, const char* end, char stop, Number& number, int base = 10) {
  const auto [next, error] = std::from_chars(at, end, number, base);
  if (error != std::errc{}) return false;
  if (next == end ? stop != '\0' : *next != stop) return false;
  at = next == end ? end : next + 1;
  return true;
}

/// What a robot knows of a tile of its map.
MapTile makeTile(const MazeMap& map, const Cell& tile) {
  MapTile found{tile};
  const Cell first{MapTile::kSide * tile.x, MapTile::kSide * tile.y};
  const int rows = static_cast<int>(map.size()) / map.columns();
  const int x_begin = std::max(first.x, map.low().x);
  const int x_end = std::min(first.x + MapTile::kSide, map.low().x + map.columns());
  const int y_begin = std::max(first.y, map.low().y);
  const int y_end = std::min(first.y + MapTile::kSide, map.low().y + rows);
  if (x_begin >= x_end) return found;
  for (int y = y_begin; y < y_end; ++y) {
    const MapCell* here = &map[{x_begin, y}];
    int bit = MapTile::kSide * (y - first.y) + x_begin - first.x;
    for (int x = x_begin; x < x_end; ++x, ++here, ++bit) {
      found.searched |= static_cast<std::uint64_t>(here->searched) << bit;
      found.occupied |= static_cast<std::uint64_t>(here->evidence >= kSureEvidence) << bit;
    }
  }
  return found;
}

}  // namespace

std::string MapMessage::text() const {
  std::string text = kMap + std::to_string(cell_um);
  for (const auto& tile : tiles) {
    text += ' ' + std::to_string(tile.tile.x) + ',' + std::to_string(tile.tile.y) + ',';
    appendHex(tile.searched, text);
    text += ',';
    appendHex(tile.occupied, text);
  }
  return text;
}

std::optional<MapMessage> MapMessage::parse(const std::string& text) {
  if (!text.starts_with(kMap) || text.ends_with(' ')) return std::nullopt;
  const char* at = text.data() + kMap.size();
  const char* const end = text.data() + text.size();
  MapMessage message;
  const bool has_tiles = text.find(' ', kMap.size()) != std::string::npos;
  if (!read(at, end, has_tiles ? ' ' : '\0', message.cell_um)) return std::nullopt;
  if (message.cell_um <= 0 || message.cell_um > kCellMax_um) return std::nullopt;
  while (at != end) {
    MapTile tile;
    if (!read(at, end, ',', tile.tile.x) || !read(at, end, ',', tile.tile.y)) return std::nullopt;
    if (!read(at, end, ',', tile.searched, 16)) return std::nullopt;
    const char* const rest = at;
    if (!read(at, end, ' ', tile.occupied, 16)) {
      at = rest;
      if (!read(at, end, '\0', tile.occupied, 16)) return std::nullopt;
    }
    if (std::abs(tile.tile.x) > kFarthest || std::abs(tile.tile.y) > kFarthest) return std::nullopt;
    message.tiles.push_back(tile);
  }
  return message;
}

std::optional<MapMessage> MapSharing::next(const MazeMap& map) {
  if (map.size() == 0) return std::nullopt;
  if (!known_) known_.emplace(MapTile::kSide * map.cellSize());
  const int rows = static_cast<int>(map.size()) / map.columns();
  const Cell low{floorDiv(map.low().x, MapTile::kSide), floorDiv(map.low().y, MapTile::kSide)};
  const Cell high{floorDiv(map.low().x + map.columns() - 1, MapTile::kSide),
                  floorDiv(map.low().y + rows - 1, MapTile::kSide)};
  known_->cover(low, high);
  const auto columns = static_cast<std::size_t>(high.x - low.x + 1);
  const std::size_t count = columns * static_cast<std::size_t>(high.y - low.y + 1);
  MapMessage message{std::llround(map.cellSize() * 1e6), {}};
  for (std::size_t i = 0; i < count && message.tiles.size() < MapMessage::kMaxTiles; ++i) {
    if (next_tile_ >= count) next_tile_ = 0;
    const Cell at{low.x + static_cast<int>(next_tile_ % columns), low.y + static_cast<int>(next_tile_ / columns)};
    ++next_tile_;
    if (!known_->contains(at)) continue;
    MapTile tile = makeTile(map, at);
    Known& known = (*known_)[at];
    tile.searched &= ~known.searched;
    tile.occupied &= ~known.occupied;
    if (tile.searched == 0 && tile.occupied == 0) continue;
    known.searched |= tile.searched;
    known.occupied |= tile.occupied;
    message.tiles.push_back(tile);
  }
  if (message.tiles.empty()) return std::nullopt;
  return message;
}

void MapSharing::receive(const MapMessage& message, SearchMap& search) {
  MazeMap& map = search.map;
  if (!known_) known_.emplace(MapTile::kSide * map.cellSize());
  const double cell_m = static_cast<double>(message.cell_um) * 1e-6;
  const bool is_same_size = message.cell_um == std::llround(map.cellSize() * 1e6);
  for (const auto& tile : message.tiles) {
    if (is_same_size) {
      known_->cover(tile.tile, tile.tile);
      if (known_->contains(tile.tile)) {
        (*known_)[tile.tile].searched |= tile.searched;
        (*known_)[tile.tile].occupied |= tile.occupied;
      }
    }
    for (int i = 0; i < MapTile::kSide * MapTile::kSide; ++i) {
      const bool is_searched = (tile.searched >> i & 1) != 0, is_occupied = (tile.occupied >> i & 1) != 0;
      if (!is_searched && !is_occupied) continue;
      const double x = MapTile::kSide * tile.tile.x + i % MapTile::kSide;
      const double y = MapTile::kSide * tile.tile.y + i / MapTile::kSide;
      const double margin = std::min(0.5, 0.5 * map.cellSize() / cell_m);  // own cells whose centre is in the sent one
      const Cell low = map.cellAt({(x + margin) * cell_m, (y + margin) * cell_m});
      const Cell high = map.cellAt({(x + 1 - margin) * cell_m, (y + 1 - margin) * cell_m});
      map.cover(low, high);
      for (Cell cell = low; cell.y <= high.y; ++cell.y) {
        for (cell.x = low.x; cell.x <= high.x; ++cell.x) {
          if (!map.contains(cell)) continue;
          if (is_searched) map[cell].searched = true;
          if (is_occupied) search.obstacles.learn(cell, Obstacles::kLearned);
        }
      }
    }
  }
}

}  // namespace robosim
