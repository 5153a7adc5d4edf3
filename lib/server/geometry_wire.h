#pragma once
#include "environment/environment.h"
#include "net/geometry.pb.h"

namespace robosim {

/// @file
/// Conversion between value types and the messages of geometry.proto. Decoding validates its input and throws WireError
/// (net/wire_error.h).

/// Encodes the part of the state that a replica requires: all that moves and range measurements depend on.
void encode(const State& state, wire::ReplicaState& out);
/// Overwrites that part of a replica's state.
void decodeInto(const wire::ReplicaState& in, State& state);

/// Encodes the range measurements of the robots [out.begin, out.end). @pre both are set.
void encode(const Environment& environment, wire::TaskResult& out);
/// Stores a result in the environment. @pre its range lies within the world's robots.
/// @throws WireError also for measurements that no correct sensor returns.
void put(const wire::TaskResult& in, Environment& environment);

/// Encodes the motion of all robots in a step: the fractions of clipped moves, and the robots that stay.
void encodeOutcome(Environment& environment, wire::Task& out);
/// @pre the environment has begun the step
void putOutcome(const wire::Task& in, Environment& environment);

}  // namespace robosim
