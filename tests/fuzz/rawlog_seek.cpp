// Fuzzes seeking in damaged rawlogs, compressed or not: reads to the end, then at positions in any order, including
// invalid ones. The first bytes of the input choose the positions; the rest is the file.
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <vector>

#include "recording/rawlog_reader.h"
#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/rawlog_memory.h"

using namespace robosim;

namespace {

constexpr std::size_t kSeeks = 8;

/// Reads to the end. @return positions of the objects
std::vector<std::uint64_t> placesIn(RawlogReader& reader) {
  std::vector<std::uint64_t> places;
  while (reader.next()) {
    if (places.empty() || places.back() != reader.position()) places.push_back(reader.position());
  }
  return places;
}

void checkSame(RawlogReader& reader, std::uint64_t place) {
  reader.seek(place);
  if (!reader.next()) throw std::logic_error("an object that was read before is not there again");
  if (reader.position() != place) throw std::logic_error("an object has moved");
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < kSeeks) return 0;
  const FileInMemory input(data + kSeeks, size - kSeeks);
  try {
    RawlogReader reader(input.path(), RawlogReader::Access::random);
    const auto places = placesIn(reader);
    for (std::size_t i = 0; i < kSeeks && !places.empty(); ++i) {
      checkSame(reader, places[data[i] % places.size()]);
      // Every other time, continues to the end or to the first error.
      if (data[i] % 2 == 0) {
        while (reader.next()) {
        }
      }
    }
  } catch (const ConfigError&) {
  }
  return 0;
}
