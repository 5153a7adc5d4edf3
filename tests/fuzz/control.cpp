// Fuzzes a world sent by a control panel.
#include "tests/fuzz/fuzz.h"
#include "wire/world_wire.h"

using namespace robosim;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return fuzzMessage<v1::WorldSource>(data, size,
                                      [](const v1::WorldSource& message) { loadWorld(decode(message), {}); });
}
