#include "world/controller_xml.h"

#include <algorithm>

#include "base/error_list.h"
#include "base/type_choice.h"

namespace robosim {

std::string readController(XmlReader& robot) {
  const auto& children = robot.element().children;
  const auto found = std::find_if(children.begin(), children.end(),
                                  [](const XmlElement& child) { return child.name == "controller"; });
  if (found == children.end() || found->attributes.empty()) {
    std::string name = robot.word("controller", "");
    try {
      if (!name.empty()) TypeChoice::parse(name);
    } catch (const ConfigError& error) {
      robot.errorAt("controller", error.what());
    }
    return name;
  }
  XmlReader controller = *robot.child("controller");
  TypeChoice choice{controller.word("name"), {}};
  for (const auto& [parameter, value] : found->attributes) {
    if (parameter == "name") continue;
    choice.parameters.emplace_back(parameter, controller.word(parameter));
    if (value.find_first_of(" \t\n") != std::string::npos) controller.errorAt(parameter, "must be a single number");
  }
  controller.finish();
  return choice.text();
}

void writeController(const std::string& controller, XmlElement& robot) {
  const TypeChoice choice = TypeChoice::parse(controller);
  XmlElement& element = robot.add("controller");
  if (choice.parameters.empty()) {
    element.text = choice.name;
    return;
  }
  element.attributes = choice.parameters;
  element.attributes.insert(element.attributes.begin(), {"name", choice.name});
}

}  // namespace robosim
