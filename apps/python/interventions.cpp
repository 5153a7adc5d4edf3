#include "interventions.h"

#include <array>
#include <optional>
#include <string>
#include <utility>

#include <pybind11/stl.h>

#include "python_errors.h"
#include "world/intervention.h"

namespace robosim {
namespace {

namespace py = pybind11;

using Color = std::array<float, 3>;

/// @throws std::invalid_argument with what is wrong
void intervene(Simulation& simulation, Change change) {
  requireUsable(simulation, SimulationAccess::structural);
  const std::string fault = simulation.environment().apply({"Python", std::move(change)});
  if (!fault.empty()) throw std::invalid_argument(fault);
  simulation.followAdditions();
}

void add(Simulation& simulation, const py::str& name, const decltype(Body::shape)& shape,
         const mrpt::math::TPose2D& pose, double height_m, std::optional<double> z_m, const Color& color,
         double heat_celsius, double reflectivity, const std::optional<Movable>& movable, double light_cd,
         double fiducial) {
  AddObject added;
  added.object.movable = movable;
  added.object.name = toBytes(name);
  added.object.body = {shape,    pose,    z_m.value_or(height_m / 2), height_m, color, heat_celsius, reflectivity,
                       light_cd, fiducial};
  intervene(simulation, added);
}

std::optional<Movable> movableOf(std::optional<double> mass_kg, std::optional<double> friction,
                                 std::optional<double> restitution) {
  if (mass_kg) return Movable{*mass_kg, friction.value_or(Movable().friction), restitution.value_or(0)};
  if (!friction && !restitution) return std::nullopt;
  throw std::invalid_argument("friction and restitution are of objects that robots push; give mass_kg, too");
}

}  // namespace

void bindInterventions(py::class_<Simulation, std::shared_ptr<Simulation>>& simulation) {
  const Color grey = Body().color;
  simulation
      .def(
          "place",
          [](Simulation& of, const py::str& name, double x, double y, std::optional<double> heading) {
            intervene(of, PlaceBody{toBytes(name), x, y, heading});
          },
          py::arg("name"), py::arg("x"), py::arg("y"), py::arg("heading") = py::none(),
          "Puts a robot or an object elsewhere between two steps: x, y [m], heading [rad], world frame; None: "
          "unchanged.\n\nRecordings contain it. An absent robot enters the world. Raises ValueError if it would "
          "overlap "
          "something.")
      .def(
          "remove", [](Simulation& of, const py::str& name) { intervene(of, RemoveBody{toBytes(name)}); },
          py::arg("name"), "Takes an object out of the world for good, or a robot until it is placed again.")
      .def(
          "add_cylinder",
          [](Simulation& of, const py::str& name, double x, double y, double radius_m, double height_m,
             std::optional<double> z_m, const Color& color, double heat_celsius, double reflectivity,
             std::optional<double> mass_kg, std::optional<double> friction, std::optional<double> restitution,
             double light_cd, double fiducial) {
            add(of, name, Cylinder{radius_m}, {x, y, 0}, height_m, z_m, color, heat_celsius, reflectivity,
                movableOf(mass_kg, friction, restitution), light_cd, fiducial);
          },
          py::arg("name"), py::arg("x"), py::arg("y"), py::arg("radius_m"), py::arg("height_m") = 1.0,
          py::arg("z_m") = py::none(), py::arg("color") = grey, py::arg("heat_celsius") = 0.0,
          py::arg("reflectivity") = kReflectivity, py::kw_only(), py::arg("mass_kg") = py::none(),
          py::arg("friction") = py::none(), py::arg("restitution") = py::none(), py::arg("light_cd") = 0.0,
          py::arg("fiducial") = 0.0,
          "Adds an upright cylinder at x, y [m]. z_m: height of its centre; None: it stands on the ground.\n\nWith "
          "mass_kg, robots push it: friction is its coefficient on the floor (of rolling for a ball; None: 0.5), "
          "restitution the share of the speed with which it leaves a collision, [0, 1] (None: 0). light_cd: its "
          "luminous "
          "intensity; fiducial: number of its mark. Below the floor it is a painted area. Raises ValueError if "
          "it would overlap something, or the "
          "name is taken.")
      .def(
          "add_box",
          [](Simulation& of, const py::str& name, double x, double y, double length_m, double width_m, double height_m,
             double heading, std::optional<double> z_m, const Color& color, double heat_celsius, double reflectivity,
             std::optional<double> mass_kg, std::optional<double> friction, std::optional<double> restitution,
             double light_cd, double fiducial) {
            add(of, name, Cube{length_m, width_m}, {x, y, heading}, height_m, z_m, color, heat_celsius, reflectivity,
                movableOf(mass_kg, friction, restitution), light_cd, fiducial);
          },
          py::arg("name"), py::arg("x"), py::arg("y"), py::arg("length_m"), py::arg("width_m"),
          py::arg("height_m") = 1.0, py::arg("heading") = 0.0, py::arg("z_m") = py::none(), py::arg("color") = grey,
          py::arg("heat_celsius") = 0.0, py::arg("reflectivity") = kReflectivity, py::kw_only(),
          py::arg("mass_kg") = py::none(), py::arg("friction") = py::none(), py::arg("restitution") = py::none(),
          py::arg("light_cd") = 0.0, py::arg("fiducial") = 0.0,
          "Adds an upright box at x, y [m], whose length is along heading [rad]; otherwise as add_cylinder().")
      .def(
          "add_robot",
          [](Simulation& of, const py::str& name, const py::str& model, double x, double y, double heading,
             const py::str& controller, const py::str& neighbour, std::optional<Color> color) {
            intervene(
                of,
                AddRobot{
                    toBytes(name), toBytes(model), {x, y, heading}, toBytes(controller), toBytes(neighbour), color});
          },
          py::arg("name"), py::arg("model"), py::arg("x"), py::arg("y"), py::arg("heading") = 0.0, py::kw_only(),
          py::arg("controller") = "", py::arg("neighbour") = "", py::arg("color") = py::none(),
          "Adds a robot of a type at x, y [m], heading [rad], world frame; it is the last of `robots`, and acts from "
          "the "
          "next step.\n\ncontroller: its name; empty: that of the simulation. Arrays taken before keep their rows. "
          "Raises ValueError if it would overlap something, the name is taken, or the type is unknown.")
      .def(
          "change",
          [](Simulation& of, const py::str& name, std::optional<double> heat_celsius, std::optional<Color> color,
             std::optional<double> height_m, std::optional<double> reflectivity, std::optional<double> light_cd,
             std::optional<double> fiducial) {
            intervene(of,
                      ChangeObject{toBytes(name), heat_celsius, color, height_m, reflectivity, {light_cd, fiducial}});
          },
          py::arg("name"), py::kw_only(), py::arg("heat_celsius") = py::none(), py::arg("color") = py::none(),
          py::arg("height_m") = py::none(), py::arg("reflectivity") = py::none(), py::arg("light_cd") = py::none(),
          py::arg("fiducial") = py::none(),
          "Changes the properties of an object that are given. Its underside stays where it is.")
      .def(
          "set_activity",
          [](Simulation& of, const py::str& robot, const std::string& activity) {
            XmlElement element;
            element.name = "activity";
            element.attributes = {{"name", toBytes(robot)}, {"value", activity}};
            intervene(of, parseChange(toXmlLine(element), "set_activity"));
          },
          py::arg("robot"), py::arg("activity"), "Makes a robot 'active', 'halted' or 'found'.")
      .def(
          "open",
          [](Simulation& of, const py::str& door, double share) {
            intervene(of, OpenDoor{toBytes(door), share});
          },
          py::arg("door"), py::arg("share") = OpenDoor().share,
          "Opens a door to a share of its way, [0, 1]; 0 closes it. It moves in the following steps.")
      .def(
          "end",
          [](Simulation& of, const py::str& outcome, const py::str& text) {
            intervene(of, EndRun{toBytes(outcome), toBytes(text)});
          },
          py::arg("outcome"), py::arg("text") = "",
          "Ends the run with an outcome for statistics, and a text for people. Further steps may be taken.")
      .def(
          "intervene", [](Simulation& of, const std::string& change) { intervene(of, parseChange(change, "change")); },
          py::arg("change"), "Changes the run by an XML element of doc/interventions.md, in metres and radians.")
      .def_property_readonly(
          "objects",
          [](const Simulation& of) {
            requireUsable(of, SimulationAccess::read);
            return py::tuple(py::cast(of.environment().objects()));
          },
          "The objects at present, as WorldObject.")
      .def_property_readonly(
          "outcome",
          [](const Simulation& of) -> std::optional<std::string> {
            requireUsable(of, SimulationAccess::read);
            const auto& ended = of.environment().state().ended;
            return ended ? std::optional(ended->outcome) : std::nullopt;
          },
          "Outcome with which the run was ended; None until then.");
}

}  // namespace robosim
