#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "robots/world_source.h"

namespace robosim {

/// The serialised v1::WorldSource that a control panel sends in pieces (untrusted input).
class WorldPieces {
 public:
  /// Maximum total size: a world file, its robot types and its maps.
  static constexpr std::size_t kBytesMax = 128u << 20;

  /// @throws WireError when the total size would exceed kBytesMax.
  void add(const std::string& piece);
  bool empty() const { return bytes_ == 0; }
  std::size_t bytes() const { return bytes_; }
  /// Parses and discards the pieces, so that the world is not held in memory twice.
  /// @throws WireError when they are not a v1::WorldSource.
  WorldSource takeSource();

 private:
  std::vector<std::string> pieces_;
  std::size_t bytes_ = 0;
};

}  // namespace robosim
