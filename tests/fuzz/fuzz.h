#pragma once
#include <cstddef>
#include <cstdint>
#include <string>

#include "base/error_list.h"
#include "net/wire_error.h"

/// What libFuzzer, or replay.cpp, calls with one input. It must come back, whatever the input is.
// NOLINTNEXTLINE(readability-identifier-naming): the name is libFuzzer's
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace robosim {

/// Reads the input as a message, if it is one, and hands it to `use`, which may refuse it.
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
