#include "run/outputs/intervention_note.h"

#include <utility>

#include <nlohmann/json.hpp>

namespace robosim {

std::string InterventionNote::text() const {
  const nlohmann::ordered_json json{{"robosim_intervention", 1},
                                    {"step", step},
                                    {"author", intervention.author},
                                    {"change", changeText(intervention.change)}};
  return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::optional<InterventionNote> InterventionNote::parse(const std::string& text) {
  const auto json = nlohmann::json::parse(text, nullptr, false);
  if (!json.is_object() || !json.contains("robosim_intervention")) return std::nullopt;
  try {
    InterventionNote note{json.at("step"), {json.at("author"), {}}};
    note.intervention.change = parseChange(json.at("change"), "intervention of step " + std::to_string(note.step));
    return note;
  } catch (const nlohmann::json::exception&) {
    return std::nullopt;
  }
}

std::vector<std::string> notesBefore(const State& state, std::uint64_t step, bool is_first) {
  std::vector<std::string> notes;
  for (const auto& applied : state.interventions) {
    if (applied.step == step) notes.push_back(InterventionNote{step, applied.intervention}.text());
  }
  if (is_first && state.objects.areChanged()) {
    nlohmann::ordered_json json{{"robosim_objects", 1}, {"objects", nlohmann::ordered_json::array()}};
    const std::vector<WorldObject> none;
    for (const auto& object : state.objects.orThose(none)) json["objects"].push_back(changeText(AddObject{object}));
    notes.push_back(json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
  }
  return notes;
}

std::optional<ChangedObjects> objectsIn(const std::string& text) {
  const auto json = nlohmann::json::parse(text, nullptr, false);
  if (!json.is_object() || !json.contains("robosim_objects")) return std::nullopt;
  std::vector<WorldObject> objects;
  for (const auto& element : json.value("objects", nlohmann::json::array())) {
    if (!element.is_string()) return std::nullopt;
    const Change change = parseChange(element, "objects of a recording");
    if (const auto* added = std::get_if<AddObject>(&change)) objects.push_back(added->object);
  }
  return ChangedObjects(std::move(objects));
}

}  // namespace robosim
