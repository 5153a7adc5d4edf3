#include "world/intervention.h"

#include <algorithm>
#include <map>
#include <type_traits>
#include <utility>

#include "base/error_list.h"
#include "base/label.h"
#include "base/xml_parser.h"
#include "world/body_xml.h"
#include "world/controller_xml.h"

namespace robosim {
namespace {

constexpr std::size_t kMaxNameBytes = 1000, kMaxOutcomeBytes = 100, kMaxEndTextBytes = 1000;

/// Activities that a change may set.
constexpr std::pair<const char*, Activity> kActivities[] = {
    {"active", Activity::active}, {"halted", Activity::halted}, {"found", Activity::found}};

std::string readText(XmlReader& reader, const char* setting, const std::string& text, std::size_t bytes_max) {
  if (text.size() > bytes_max) {
    reader.errorAt(setting, "has " + std::to_string(text.size()) + " bytes; the most is " + std::to_string(bytes_max));
  }
  return text;
}

std::string readName(XmlReader& reader) { return readText(reader, "name", reader.word("name"), kMaxNameBytes); }

// Each kind of change has a function that reads its element and one that writes it.

PlaceBody readPlaceBody(XmlReader& reader, double unit_m) {
  PlaceBody place{readName(reader), reader.length("x", Bounds::any(), unit_m),
                  reader.length("y", Bounds::any(), unit_m)};
  if (reader.has("direction")) place.heading_rad = reader.number("direction");
  return place;
}
void write(const PlaceBody& place, double unit_m, XmlElement& element) {
  element.name = "place";
  element.attributes = {{"name", place.name}, {"x", toText(place.x_m, unit_m)}, {"y", toText(place.y_m, unit_m)}};
  if (place.heading_rad) element.attributes.emplace_back("direction", toText(*place.heading_rad));
}

AddRobot readAddRobot(XmlReader& robot, double unit_m) {
  AddRobot add;
  add.name = robot.word("name");
  if (const std::string fault = robotNameError(add.name); !fault.empty()) robot.errorAt("name", fault);
  add.model = readText(robot, "model", robot.word("model"), kMaxNameBytes);
  add.world_from_robot = readPose(robot, unit_m);
  add.controller = readController(robot);
  add.neighbour = readText(robot, "neighbour", robot.word("neighbour", ""), kMaxNameBytes);
  add.color = readColor(robot);
  robot.finish();
  return add;
}
void write(const AddRobot& add, double unit_m, XmlElement& element) {
  element.name = "add";
  XmlElement& robot = element.add("robot");
  robot.attributes = {{"model", add.model},
                      {"name", add.name},
                      {"x", toText(add.world_from_robot.x, unit_m)},
                      {"y", toText(add.world_from_robot.y, unit_m)},
                      {"direction", toText(add.world_from_robot.phi)}};
  if (add.color) robot.attributes.emplace_back("color", colorText(*add.color));
  if (!add.neighbour.empty()) robot.attributes.emplace_back("neighbour", add.neighbour);
  if (!add.controller.empty()) writeController(add.controller, robot);
}

Change readAdd(XmlReader& reader, double unit_m) {
  if (auto robot = reader.child("robot")) return readAddRobot(*robot, unit_m);
  AddObject add;
  auto solid = solidIn(reader);
  if (!solid) {
    reader.error("contains neither a <cylinder> nor a <cube> nor a <robot>; add one");
    return add;
  }
  add.object.line = solid->line();
  add.object.name = readName(*solid);
  add.object.body = readBody(*solid, unit_m, true);
  readMotion(*solid, unit_m, add.object);
  solid->finish();
  return add;
}
void write(const AddObject& add, double unit_m, XmlElement& element) {
  element.name = "add";
  writeObject(add.object, unit_m, true, element);
}

RemoveBody readRemoveBody(XmlReader& reader, double) { return {readName(reader)}; }
void write(const RemoveBody& remove, double, XmlElement& element) {
  element.name = "remove";
  element.attributes = {{"name", remove.name}};
}

ChangeObject readChangeObject(XmlReader& reader, double unit_m) {
  ChangeObject change{readName(reader)};
  if (reader.has("hot")) change.heat_celsius = reader.number("hot", Bounds::notNegative());
  change.color = readColor(reader);
  if (reader.has("height")) change.height_m = reader.length("height", Bounds::positive(), unit_m);
  if (reader.has("reflectivity")) change.reflectivity = reader.number("reflectivity", {0, 1});
  for (std::size_t i = 0; i < kBodyProperties.size(); ++i) {
    if (reader.has(kBodyProperties[i].name)) change.properties[i] = readProperty(reader, kBodyProperties[i], 0);
  }
  if (change == ChangeObject{change.name}) {
    std::string properties = "hot, color, height, reflectivity";
    for (const BodyProperty& property : kBodyProperties) {
      properties += std::string(&property == &kBodyProperties.back() ? " or " : ", ") + property.name;
    }
    reader.error("changes nothing; give " + properties);
  }
  return change;
}
void write(const ChangeObject& change, double unit_m, XmlElement& element) {
  element.name = "change";
  const auto add = [&](const char* name, std::string text) { element.attributes.emplace_back(name, std::move(text)); };
  add("name", change.name);
  if (change.heat_celsius) add("hot", toText(*change.heat_celsius));
  if (change.color) add("color", colorText(*change.color));
  if (change.height_m) add("height", toText(*change.height_m, unit_m));
  if (change.reflectivity) add("reflectivity", toText(*change.reflectivity));
  for (std::size_t i = 0; i < kBodyProperties.size(); ++i) {
    if (change.properties[i]) add(kBodyProperties[i].name, toText(*change.properties[i]));
  }
}

ChangeActivity readChangeActivity(XmlReader& reader, double) {
  return {readName(reader),
          reader.choice<Activity>("value", {kActivities[0], kActivities[1], kActivities[2]}, Activity::active)};
}
void write(const ChangeActivity& change, double, XmlElement& element) {
  element.name = "activity";
  const auto found = std::find_if(std::begin(kActivities), std::end(kActivities),
                                  [&](const auto& named) { return named.second == change.activity; });
  element.attributes = {{"name", change.robot}, {"value", found == std::end(kActivities) ? "absent" : found->first}};
}

ChangeRadio readChangeRadio(XmlReader& reader, double unit_m) { return {readCommunication(reader, unit_m)}; }
void write(const ChangeRadio& change, double unit_m, XmlElement& element) {
  element.name = "communication";
  writeCommunication(change.communication, unit_m, element);
}

OpenDoor readOpenDoor(XmlReader& reader, double) {
  return {readName(reader), reader.number("share", {0, 1}, OpenDoor().share)};
}
void write(const OpenDoor& open, double, XmlElement& element) {
  element.name = "open";
  element.attributes = {{"name", open.name}, {"share", toText(open.share)}};
}

EndRun readEndRun(XmlReader& reader, double) {
  return {readText(reader, "outcome", reader.word("outcome"), kMaxOutcomeBytes),
          readText(reader, "text", reader.word("text", ""), kMaxEndTextBytes)};
}
void write(const EndRun& end, double, XmlElement& element) {
  element.name = "end";
  element.attributes = {{"outcome", end.outcome}};
  if (!end.text.empty()) element.attributes.emplace_back("text", end.text);
}

template <auto kRead>
Change readAs(XmlReader& reader, double unit_m) {
  return kRead(reader, unit_m);
}

/// Readers of the changes, by the name of the element.
const std::map<std::string, Change (*)(XmlReader&, double)>& readers() {
  static const std::map<std::string, Change (*)(XmlReader&, double)> all{
      {"place", readAs<readPlaceBody>},         {"add", readAs<readAdd>},
      {"remove", readAs<readRemoveBody>},       {"change", readAs<readChangeObject>},
      {"activity", readAs<readChangeActivity>}, {"communication", readAs<readChangeRadio>},
      {"open", readAs<readOpenDoor>},           {"end", readAs<readEndRun>}};
  return all;
}

}  // namespace

Change readChange(XmlReader& reader, double unit_m) {
  const auto found = readers().find(reader.name());
  if (found == readers().end()) {
    std::vector<std::string> names;
    for (const auto& [name, read] : readers()) names.push_back(name);
    reader.error("is no change of a run; changes are: " + listed(names));
    return {};
  }
  Change change = found->second(reader, unit_m);
  reader.finish();
  return change;
}

XmlElement toElement(const Change& change, double unit_m) {
  XmlElement element;
  std::visit([&](const auto& kind) { write(kind, unit_m, element); }, change);
  return element;
}

Change parseChange(std::string text, const std::string& where) {
  const XmlElement element = parseXml(std::move(text), where);
  ErrorList errors;
  XmlReader reader(element, where, errors);
  Change change = readChange(reader, 1);
  errors.throwIfAny();
  return change;
}

std::string changeText(const Change& change) { return toXmlLine(toElement(change)); }

std::string faultOf(const Change& change) {
  const std::string where = "change";
  try {
    if (parseChange(changeText(change), where) == change) return {};
    return "a text of it has characters that XML cannot contain, or spaces around it; leave them out";
  } catch (const ConfigError& error) {
    const std::string& fault = error.errors().front();
    const std::size_t text = fault.find(": ");
    return fault.starts_with(where + ":") && text != std::string::npos ? fault.substr(text + 2) : fault;
  }
}

}  // namespace robosim
