#include "robosim/control_changes.h"

#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/angle_units.h"
#include "base/error_list.h"
#include "base/xml_parser.h"

namespace robosim {
namespace {

/// Arguments of all the subcommands.
struct ChangeArguments {
  std::string name, element, value, outcome, text;
  double x_m = 0, y_m = 0, share = 1;
  std::optional<double> heading_deg, heat_celsius, height_m, reflectivity;
  std::vector<float> color;
  decltype(ChangeObject::properties) properties;
};

}  // namespace

void addChanges(CLI::App& control, const std::function<void(const Change&)>& supervise) {
  const auto a = std::make_shared<ChangeArguments>();
  const auto add = [&](const char* name, const char* help, const std::function<Change()>& change) {
    auto* command = control.add_subcommand(name, help);
    command->fallthrough();
    command->callback([supervise, change] { supervise(change()); });
    return command;
  };
  const auto add_name = [&](CLI::App& command, const char* help) {
    command.add_option("NAME", a->name, help)->required()->type_name("NAME");
  };

  auto* place = add("place", "put a robot or an object elsewhere", [a]() -> Change {
    PlaceBody body{a->name, a->x_m, a->y_m, {}};
    if (a->heading_deg) body.heading_rad = toRadians(*a->heading_deg);
    return body;
  });
  add_name(*place, "of the robot or object");
  place->add_option("X", a->x_m, "x of its centre, in metres")->required()->type_name("METRES");
  place->add_option("Y", a->y_m, "y of its centre, in metres")->required()->type_name("METRES");
  place->add_option("HEADING", a->heading_deg, "in degrees, counter-clockwise from the x axis; default: unchanged")
      ->type_name("DEGREES");

  auto* remove = add("remove", "take an object out of the world, or a robot until it is placed again",
                     [a]() -> Change { return RemoveBody{a->name}; });
  add_name(*remove, "of the robot or object");

  auto* add_object =
      add("add", "add an object or a robot", [a] { return parseChange("<add>" + a->element + "</add>", "ELEMENT"); });
  add_object
      ->add_option("ELEMENT", a->element,
                   "a <cylinder> or <cube> with its name, or a <robot> of a type, as in a world file, in metres")
      ->required()
      ->type_name("XML");

  auto* change = add("change", "change properties of an object", [a]() -> Change {
    ChangeObject object{a->name, a->heat_celsius, {}, a->height_m, a->reflectivity, a->properties};
    if (!a->color.empty()) object.color = {a->color[0], a->color[1], a->color[2]};
    return object;
  });
  add_name(*change, "of the object");
  change->add_option("--heat", a->heat_celsius, "0 gives off none")->type_name("CELSIUS");
  change->add_option("--color", a->color, "red, green, blue, each in [0, 1]")
      ->expected(3)
      ->delimiter(',')
      ->type_name("R,G,B");
  change->add_option("--height", a->height_m, "its underside stays")->type_name("METRES");
  change->add_option("--reflectivity", a->reflectivity, "of a laser's light, [0, 1]")->type_name("SHARE");
  for (std::size_t i = 0; i < kBodyProperties.size(); ++i) {
    const BodyProperty& property = kBodyProperties[i];
    change->add_option(std::string("--") + property.name, a->properties[i], property.help)->type_name(property.unit);
  }

  auto* activity = add("activity", "make a robot active, halted or found", [a] {
    XmlElement element;
    element.name = "activity";
    element.attributes = {{"name", a->name}, {"value", a->value}};
    return parseChange(toXmlLine(element), "activity");
  });
  add_name(*activity, "of the robot");
  activity->add_option("VALUE", a->value, "active, halted or found")
      ->required()
      ->check(CLI::IsMember({"active", "halted", "found"}))
      ->type_name("active|halted|found");

  auto* open = add("open", "open a door", [a]() -> Change { return OpenDoor{a->name, a->share}; });
  add_name(*open, "of the door");
  open->add_option("SHARE", a->share, "of its way, [0, 1]; 0 closes it; default: 1")->type_name("SHARE");

  auto* end = add("end", "end the run with an outcome", [a]() -> Change { return EndRun{a->outcome, a->text}; });
  end->add_option("OUTCOME", a->outcome, "a word for statistics")->required()->type_name("WORD");
  end->add_option("TEXT", a->text, "for people")->type_name("TEXT");
}

}  // namespace robosim
