#pragma once
#include "environment/environment.h"
#include "robosim/internal/geometry.pb.h"

namespace robosim {

/// @file
/// Conversion between value types and the messages of robosim/internal/geometry.proto. Decoding validates its input and
/// throws WireError (net/wire_error.h).

/// Encodes the part of the state that a replica requires: all that moves and range measurements depend on.
void encode(const State& state, internal::ReplicaState& out);
/// Overwrites that part of a replica's state.
void decodeInto(const internal::ReplicaState& in, State& state);

/// Encodes the range measurements of the robots [out.begin, out.end). @pre both are set.
void encode(const Environment& environment, internal::TaskResult& out);
/// Stores a result in the environment. @pre its range lies within the world's robots.
/// @throws WireError also for measurements that no correct sensor returns.
void put(const internal::TaskResult& in, Environment& environment);

/// Adds a robot's command to a task.
void addCommand(std::size_t robot, const Command& command, internal::Task& out);
/// Sets the commands of a task. @throws WireError for an unknown robot or an invalid command.
void putCommands(const internal::Task& in, Environment& environment);

/// Encodes the motion of all robots in a step: the fractions of clipped moves, and the robots that stay.
void encodeOutcome(Environment& environment, internal::Task& out);
/// @pre the environment has begun the step
void putOutcome(const internal::Task& in, Environment& environment);

}  // namespace robosim
