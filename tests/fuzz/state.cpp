// Fuzzes the contents of saved states: the input replaces them in a state of the small maze, with header and checksum
// as the format requires.
#include <cstring>

#include "base/digest.h"
#include "environment/state_bytes.h"
#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/small_maze.h"

using namespace robosim;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr std::size_t kHeaderBytes = 36, kSizeAt = 20;
  Environment& environment = smallMaze();
  static const std::string header = toBytes(*environment.model(), environment.state()).substr(0, kHeaderBytes);
  std::string bytes = header + std::string(reinterpret_cast<const char*>(data), size);
  const std::uint64_t total = bytes.size() + sizeof total;
  std::memcpy(bytes.data() + kSizeAt, &total, sizeof total);
  Digest digest;
  digest.addBytes(bytes.data(), bytes.size());
  const std::uint64_t checksum = digest.value();
  bytes.append(reinterpret_cast<const char*>(&checksum), sizeof checksum);
  try {
    environment.restore(stateFromBytes(*environment.model(), bytes));
    environment.step();
  } catch (const ConfigError&) {
  }
  return 0;
}
