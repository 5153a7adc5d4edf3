// Fuzzes recordings of ROS 2 and logs of CARMEN: reads all observations, and those at places in any order.
#include <stdexcept>
#include <string>
#include <vector>

#include "recording/rawlog_reader.h"
#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/rawlog_memory.h"

using namespace robosim;

namespace {

struct Observed {
  std::uint64_t position = 0;
  std::string label;
};

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const FileInMemory input(data, size);
  try {
    RawlogReader reader(input.path(), RawlogReader::Access::random);
    if (!reader.isForeign()) return 0;
    std::vector<Observed> all;
    while (const auto observation = reader.next()) all.push_back({reader.position(), observation->sensorLabel});
    for (std::size_t i = 0; i < 4 && !all.empty(); ++i) {
      const Observed& one = all[data[size - 1 - i] % all.size()];
      reader.seek(one.position);
      auto again = reader.next();
      // A line of a log of CARMEN has several observations.
      while (again && again->sensorLabel != one.label && reader.position() == one.position) again = reader.next();
      if (!again || again->sensorLabel != one.label) throw std::logic_error("an observation is not there again");
    }
  } catch (const ConfigError&) {
  }
  return 0;
}
