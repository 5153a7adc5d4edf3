#pragma once
#include <string>
#include <string_view>

#include "environment/model.h"
#include "environment/state.h"

namespace robosim {

/// @file
/// A State as bytes, to be stored in a file or sent to another process. Format, little-endian: magic (16 bytes),
/// version (u32), number of all bytes (u64), digestOf(Model) (u64), contents, which end with the digest if the state
/// has one, and the XXH3-64 hash of all bytes before it. The checksum detects damage, not manipulation; forged contents
/// are memory-safe, and may describe an impossible run.

/// Saves a state between two steps.
std::string toBytes(const Model& model, const State& state);

/// Reads a state of this model.
/// @throws ConfigError for bytes of another kind, that are truncated or damaged, or of another version or model
State stateFromBytes(const Model& model, std::string_view bytes);

}  // namespace robosim
