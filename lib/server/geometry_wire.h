#pragma once
#include "environment/environment.h"
#include "net/geometry.pb.h"

namespace robosim {

/// @file
/// The geometry workers' conversation between our values and protobuf's (geometry.proto). Decoding takes nothing on
/// trust: it throws WireError (net/wire_error.h).

void encode(const Moment& moment, wire::Moment& out);
/// @param robots how many the world has
Moment decode(const wire::Moment& in, std::size_t robots);

/// What has been worked out of a part for the robots [out.begin, out.end), which are set.
void encode(Environment& environment, wire::TaskResult& out);
/// Puts a result into the environment. @pre its range lies within the world's robots.
void put(const wire::TaskResult& in, Environment& environment);

/// What all robots did in the part before `part`, which is set in `out`: where the clipped ones stop, or who stays.
void encodeOutcome(const Environment& environment, wire::Task& out);
void putOutcome(const wire::Task& in, Environment& environment);

}  // namespace robosim
