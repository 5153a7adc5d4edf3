// What an environment shows to viewers.
#include "server/viewer.h"
#include "tests/fuzz/fuzz.h"

using namespace robosim;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return fuzzMessage<wire::Frame>(data, size, [](const wire::Frame& frame) {
    Sight sight;
    sight.robots.resize(3);
    update(sight, frame);
  });
}
