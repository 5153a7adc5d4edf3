#include "run/outputs/intervention_note.h"

#include <utility>

#include <nlohmann/json.hpp>

namespace robosim {
namespace {

std::string dumped(const nlohmann::ordered_json& json) {
  return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

/// nullopt if the comment is no note of an intervention. @throws ConfigError for one whose change is invalid
std::optional<InterventionNote> noteIn(const nlohmann::json& json) {
  if (!json.is_object() || !json.contains("robosim_intervention")) return std::nullopt;
  try {
    InterventionNote note{json.at("step"), {json.at("author"), {}}};
    note.intervention.change = parseChange(json.at("change"), "intervention of step " + std::to_string(note.step));
    return note;
  } catch (const nlohmann::json::exception&) {
    return std::nullopt;
  }
}

/// The objects after a comment of movedNote(), from those before; nullopt if it is none, or of other objects.
std::optional<ChangedObjects> movedBy(const nlohmann::json& json, const std::vector<WorldObject>& before) {
  if (!json.is_object() || !json.contains("robosim_moved")) return std::nullopt;
  try {
    std::vector<WorldObject> objects = before;
    for (const auto& place : json.at("places")) {
      objects.at(place.at(0).get<std::size_t>()).body.world_from_body = {place.at(1), place.at(2), place.at(3)};
    }
    return ChangedObjects(std::move(objects));
  } catch (const std::exception&) {  // of another form, or of an object that there is not
    return std::nullopt;
  }
}

/// The objects in a comment of allObjectsNote(); nullopt if it is none. @throws ConfigError for an invalid object
std::optional<ChangedObjects> objectsIn(const nlohmann::json& json) {
  if (!json.is_object() || !json.contains("robosim_objects")) return std::nullopt;
  std::vector<WorldObject> objects;
  for (const auto& element : json.value("objects", nlohmann::json::array())) {
    if (!element.is_string()) return std::nullopt;
    const Change change = parseChange(element, "objects of a recording");
    if (const auto* added = std::get_if<AddObject>(&change)) objects.push_back(added->object);
  }
  return ChangedObjects(std::move(objects));
}

}  // namespace

std::string InterventionNote::text() const {
  const nlohmann::ordered_json json{{"robosim_intervention", 1},
                                    {"step", step},
                                    {"author", intervention.author},
                                    {"change", changeText(intervention.change)}};
  return dumped(json);
}

std::optional<InterventionNote> InterventionNote::parse(const std::string& text) {
  return noteIn(nlohmann::json::parse(text, nullptr, false));
}

std::vector<std::string> notesBefore(const State& state, std::uint64_t step, bool is_first) {
  std::vector<std::string> notes;
  for (const auto& applied : state.interventions) {
    if (applied.step == step) notes.push_back(InterventionNote{step, applied.intervention}.text());
  }
  for (const AddRobot& robot : is_first ? state.additions.list() : std::span<const AddRobot>()) {
    notes.push_back(dumped(nlohmann::ordered_json{{"robosim_robot", 1}, {"added", changeText(robot)}}));
  }
  if (is_first && state.objects.areChanged()) notes.push_back(allObjectsNote(state.objects));
  return notes;
}

std::optional<AddRobot> robotAddedBy(const std::string& text) {
  if (text.find("<add><robot") == std::string::npos) return std::nullopt;  // saves the time to parse it
  const auto json = nlohmann::json::parse(text, nullptr, false);
  std::optional<Change> change;
  if (const auto note = noteIn(json)) {
    change = note->intervention.change;
  } else if (json.is_object() && json.contains("robosim_robot") && json.value("added", nlohmann::json()).is_string()) {
    change = parseChange(json.at("added"), "a robot of a recording");
  }
  const auto* robot = change ? std::get_if<AddRobot>(&*change) : nullptr;
  return robot ? std::optional(*robot) : std::nullopt;
}

std::string allObjectsNote(const ChangedObjects& changed) {
  nlohmann::ordered_json json{{"robosim_objects", 1}, {"objects", nlohmann::ordered_json::array()}};
  const std::vector<WorldObject> none;
  for (const auto& object : changed.orThose(none)) json["objects"].push_back(changeText(AddObject{object}));
  return dumped(json);
}

std::string movedNote(const ChangedObjects& recorded, const ChangedObjects& now,
                      const std::optional<std::vector<std::uint32_t>>& moved) {
  if (!now.areChanged()) return {};
  if (!moved || !recorded.areChanged()) return allObjectsNote(now);
  if (moved->empty()) return {};
  nlohmann::ordered_json json{{"robosim_moved", 1}, {"places", nlohmann::ordered_json::array()}};
  const std::vector<WorldObject> none;
  const auto& objects = now.orThose(none);
  for (const auto i : *moved) {
    const auto& pose = objects[i].body.world_from_body;
    json["places"].push_back({i, pose.x, pose.y, pose.phi});
  }
  return dumped(json);
}

bool isNoteOfAllObjects(const std::string& text) { return text.starts_with("{\"robosim_objects\""); }

std::optional<ChangedObjects> objectsAfter(const std::string& text, const std::vector<WorldObject>& before) {
  const auto json = nlohmann::json::parse(text, nullptr, false);
  if (auto all = objectsIn(json)) return all;
  if (auto moved = movedBy(json, before)) return moved;
  const auto note = noteIn(json);
  if (!note) return std::nullopt;
  std::vector<WorldObject> after = withChange(before, note->intervention.change);
  if (after == before) return std::nullopt;
  return ChangedObjects(std::move(after));
}

}  // namespace robosim
