#pragma once
#include <cstddef>
#include <cstdint>
#include <string>

#include "base/error_list.h"
#include "net/wire_error.h"

/// Entry point called by libFuzzer or replay.cpp with one input. Must return for every input.
// NOLINTNEXTLINE(readability-identifier-naming): name required by libFuzzer
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace robosim {

/// Parses the input as a message and, if valid, passes it to `use`, which may reject it.
template <typename Message, typename Use>
int fuzzMessage(const std::uint8_t* data, std::size_t size, const Use& use) {
  Message message;
  if (!message.ParseFromArray(data, static_cast<int>(size))) return 0;
  try {
    use(message);
  } catch (const WireError&) {
  } catch (const ConfigError&) {
  }
  return 0;
}

}  // namespace robosim
