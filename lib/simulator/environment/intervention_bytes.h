#pragma once
#include "environment/state.h"
#include "environment/state_stream.h"

namespace robosim {

/// @file
/// Interventions and what they have changed, as parts of a saved state (state_bytes.h) and of what processes that share
/// a run exchange.

void writeIntervention(const Intervention& intervention, StateWriter& out);
/// @throws InvalidContents
Intervention readIntervention(StateReader& in);

/// The objects that a state has instead of those of its model, if it has any.
/// @throws InvalidContents unless it is a robot that is added
AddRobot readAddition(StateReader& in);
void writeObjects(const ChangedObjects& objects, StateWriter& out);
/// @throws InvalidContents
ChangedObjects readObjects(StateReader& in);

/// State::object_speeds, after the objects.
void writeSpeeds(const State& state, StateWriter& out);
/// @param state has its objects already @throws InvalidContents
void readSpeeds(StateReader& in, State& state);

/// State::closed_grippers.
void writeGrippers(const State& state, StateWriter& out);
/// @param state has its objects already @param robots in the world @throws InvalidContents
void readGrippers(StateReader& in, std::size_t robots, State& state);

/// All members of the state that interventions change but those of robots.
void writeInterventions(const State& state, StateWriter& out);
/// @param state its time is that of the saved state @throws InvalidContents
void readInterventions(StateReader& in, State& state);

}  // namespace robosim
