#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "environment/state.h"
#include "world/intervention.h"

namespace robosim {

/// An intervention in a recording: JSON in a CObservationComment before the observations of the step in which it has
/// its first effect (doc/rawlog.md).
struct InterventionNote {
  std::uint64_t step = 0;  ///< AppliedIntervention::step
  Intervention intervention;

  std::string text() const;
  /// nullopt if the comment is no such note. @throws ConfigError for one whose change is invalid
  static std::optional<InterventionNote> parse(const std::string& text);
};

/// Texts of the notes of a state's interventions before a step.
/// @param is_first whether a recording begins with this step: then also of the objects, if they have been changed,
/// and of robots that have been added before
std::vector<std::string> notesBefore(const State& state, std::uint64_t step, bool is_first);
/// The robot that a comment of a recording adds: by an intervention, or, at the beginning of a recording, by one before
/// it; nullopt for none. @throws ConfigError for an invalid change
std::optional<AddRobot> robotAddedBy(const std::string& text);
/// The note of all objects. @pre they are changed
std::string allObjectsNote(const ChangedObjects& objects);
/// The note of objects that have moved since a recorded step: their places, or all objects if those were not recorded.
/// Empty if none have.
/// @param moved what movedBetween() has returned for them
std::string movedNote(const ChangedObjects& recorded, const ChangedObjects& now,
                      const std::optional<std::vector<std::uint32_t>>& moved);
/// Whether a comment of a recording is a list of all objects.
bool isNoteOfAllObjects(const std::string& text);
/// The objects after a comment of a recording, from those before: by interventions, by robots that have moved them, or
/// by a list of all; nullopt for a comment that changes none. @throws ConfigError for an invalid change or object
std::optional<ChangedObjects> objectsAfter(const std::string& text, const std::vector<WorldObject>& before);

}  // namespace robosim
