// Python's class Simulation.
#include <algorithm>

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "environment/state_bytes.h"
#include "interventions.h"
#include "pictures.h"
#include "python_errors.h"
#include "python_robot.h"
#include "simulation.h"
#include "simulation_arrays.h"
#include "whole_number.h"

namespace robosim {
namespace {

namespace py = pybind11;

using SimulationHandle = std::shared_ptr<Simulation>;

const Simulation& toRead(const Simulation& simulation) {
  requireUsable(simulation, SimulationAccess::read);
  return simulation;
}

const State& stateOf(const Simulation& simulation) { return toRead(simulation).environment().state(); }

/// @throws pybind11::type_error
SimulationHandle make(const std::shared_ptr<PythonWorld>& world, Seed seed, double period_s,
                      WholeNumber<"threads", int, "1 to 1024"> threads, const std::string& controller,
                      const py::dict& controllers) {
  if (!(period_s > 0 && period_s <= 1))
    throw std::invalid_argument("period_s is " + std::to_string(period_s) +
                                "; it must be a number of seconds in (0, 1], for example 0.1");
  if (threads < 1 || threads > 1024)
    throw std::invalid_argument("threads is " + std::to_string(threads.value) +
                                "; it must be 1 to 1024, for example 2");
  Simulation::Options options;
  options.run.environment = {seed.value, period_s, threads.value};
  options.run.controller = controller;
  for (const auto& [robot, of_robot] : controllers) {
    const std::string name = toBytes(py::str(robot));
    if (py::isinstance<py::str>(of_robot)) {
      options.named[name] = toBytes(py::reinterpret_borrow<py::str>(of_robot));
    } else if (py::hasattr(of_robot, "step") && !PyType_Check(of_robot.ptr())) {
      options.of_python[name] = py::reinterpret_borrow<py::object>(of_robot);
    } else {
      throw py::type_error("the controller of robot '" + name +
                           "' must be the name of a controller, or an object with a method step(robot)");
    }
  }
  return std::make_shared<Simulation>(world, std::move(options));
}

using SimulationClass = py::class_<Simulation, SimulationHandle>;

void bindStepping(SimulationClass& simulation) {
  simulation
      .def(
          "step",
          [](const SimulationHandle& of, WholeNumber<"the number of steps", std::int64_t, "at least 0"> n) {
            requireUsable(*of, SimulationAccess::structural);
            if (n < 0)
              throw std::invalid_argument("the number of steps is " + std::to_string(n.value) +
                                          "; it must be at least 0, for example 1");
            of->step(static_cast<std::uint64_t>(n.value));
          },
          py::arg("n") = 1,
          "Runs all controllers and takes a time step, n times.\n\nOther threads run meanwhile; Ctrl-C raises "
          "KeyboardInterrupt between two steps.\nRaises ControllerError for an exception of a controller; that step is "
          "not taken.")
      .def_property_readonly(
          "time_s", [](const Simulation& of) { return stateOf(of).time.seconds(); }, "Simulated time [s].")
      .def_property_readonly(
          "step_count", [](const Simulation& of) { return stateOf(of).time.step; }, "Number of steps since the start.")
      .def_property_readonly(
          "period_s", [](const Simulation& of) { return stateOf(of).time.period_s; }, "Length of a step [s].")
      .def_property_readonly(
          "all_halted", [](const Simulation& of) { return toRead(of).environment().allHalted(); },
          "Whether every robot has halted or found its target.")
      .def_property_readonly(
          "winner",
          [](const Simulation& of) -> py::object {
            const auto winner = stateOf(of).winner();
            if (!winner) return py::none();
            return toPython(of.environment().robotNames()[*winner]);
          },
          "Name of the robot that has won; None until then.")
      .def_property_readonly(
          "digest", [](const Simulation& of) { return toRead(of).environment().digest(); },
          "Hash over all states and readings so far; equal runs have equal digests.");
}

void bindArrays(SimulationClass& simulation) {
  simulation
      .def_property_readonly(
          "poses", posesOf,
          "True poses: float64, shape (robots, 3): x, y [m] and heading [rad], world frame.\n\nA view "
          "without a copy: it changes with each step and cannot be written.")
      .def_property(
          "commands", commandsOf, setCommands,
          "Speed [m/s] and turn rate [rad/s] of each robot: float64, shape (robots, 2).\n\nReading gives a view "
          "like poses. Assigning an array commands the robots without a controller;\nrows of others are "
          "ignored. Commands are kept until the next ones.")
      .def_property_readonly("stalled", stalledOf,
                             "Whether an obstacle stopped each robot in the last step: bool, shape (robots,); a view.")
      .def("readings", readingsOf, py::arg("kind"), py::arg("out") = py::none(),
           "Readings of the first sensor of a kind, or of the sensor with this label, of each robot: float32, shape "
           "(robots, values).\n\nkind: 'sonar', "
           "'laser', 'infrared', 'beacons' (ranges [m]), 'heat' [°C], 'compass' [rad], 'battery' [V],\n'bumper' (0 or "
           "1), "
           "'odometry' (x, y [m], heading [rad], speed [m/s], turn rate [rad/s]), 'values', 'blob_finder'\n(pixels, "
           "centre x "
           "and y, left, top, width, height of the blob of each colour [px]), 'stalled' (0 or 1), "
           "'pose'. "
           "Rows of robots without the sensor, and the ends of shorter ones, are NaN.\nThe array is new, or out, which "
           "must have this shape and type.");
}

/// Pictures by the names of the robots that have one in this step.
py::dict imagesOf(Simulation& of, const std::string& sensor) {
  requireUsable(of, SimulationAccess::read);
  const auto& robots = of.environment().fleet().robots;
  const auto takes_pictures = [&](const SensorInfo& info) {
    return info.kind == SensorKind::camera && (sensor == nameOf(info.kind) || sensor == info.label);
  };
  py::dict images;
  bool is_known = false;
  for (std::size_t i = 0; i < robots.size(); ++i) {
    const auto& sensors = *robots[i].info.sensors;
    if (std::none_of(sensors.begin(), sensors.end(), takes_pictures)) continue;
    is_known = true;
    py::object image = robotImage(of.robot(i), sensor);
    if (!image.is_none()) images[toPython(robots[i].info.name)] = std::move(image);
  }
  if (is_known) return images;
  throw std::invalid_argument("no robot has the camera '" + sensor +
                              "'; give a robot <camera/>, such as those of type pioneer3dx_camera");
}

void bindPictures(SimulationClass& simulation) {
  simulation
      .def(
          "image",
          [](Simulation& of, const py::str& robot, const std::string& sensor) {
            requireUsable(of, SimulationAccess::read);
            return robotImage(of.robot(of.indexOf(toBytes(robot))), sensor);
          },
          py::arg("robot"), py::arg("sensor") = "camera",
          "Picture that a robot's camera took in the last step: uint8, shape (height, width, 3): red, green, blue, the "
          "first row at the top.\n\nNone in a step without one, because of the camera's rate.")
      .def(
          "images", imagesOf, py::arg("sensor") = "camera",
          "The pictures of the last step, as image(), by the names of the robots that took one: of the first camera of "
          "each, or of the camera with this label.");
}

void bindMessages(SimulationClass& simulation) {
  simulation
      .def(
          "send",
          [](Simulation& of, const py::str& sender, const py::str& receiver, const py::str& text) {
            requireUsable(of, SimulationAccess::command);
            of.environment().send(of.indexOf(toBytes(sender)), toBytes(receiver), toBytes(text));
          },
          py::arg("sender"), py::arg("receiver"), py::arg("text"),
          "Sends a message from a robot to another one, delivered in the next step; at most 4096 bytes.")
      .def(
          "broadcast",
          [](Simulation& of, const py::str& sender, const py::str& text) {
            requireUsable(of, SimulationAccess::command);
            of.environment().broadcast(of.indexOf(toBytes(sender)), toBytes(text));
          },
          py::arg("sender"), py::arg("text"),
          "Sends a message from a robot to every other one, delivered in the next step to those that the radio\n"
          "reaches; at most 4096 bytes. It counts as one message.")
      .def(
          "inbox",
          [](const Simulation& of, const py::str& robot) {
            return inboxOf(stateOf(of).readings[of.indexOf(toBytes(robot))]);
          },
          py::arg("robot"), "Messages that a robot received in the last step, as a list of Message(sender, text).")
      .def(
          "robot",
          [](Simulation& of, const py::str& name) {
            requireUsable(of, SimulationAccess::read);
            return PythonRobot(of, of.indexOf(toBytes(name)));
          },
          py::arg("name"), "A robot as its controller sees it: Robot.");
}

void bindSaving(SimulationClass& simulation) {
  simulation
      .def(
          "save",
          [](const Simulation& of) {
            const State& state = stateOf(of);
            return py::bytes(toBytes(*of.environment().model(), state));
          },
          "State of the environment as bytes, with version and checksum.\n\nThe memory of controllers is not part of "
          "it; fork() copies them, too.")
      .def(
          "restore",
          [](Simulation& of, const py::bytes& state) {
            requireUsable(of, SimulationAccess::structural);
            of.restore(std::string_view(state));
          },
          py::arg("state"),
          "Continues from a state saved by a simulation of the same world, seed and period.\n\nRaises ConfigError for "
          "other bytes; the state is then unchanged.")
      .def(
          "fork",
          [](const Simulation& of) {
            requireUsable(of, SimulationAccess::structural);
            return of.fork();
          },
          "A simulation that continues independently from the present state.\n\nControllers are copied, those in "
          "Python "
          "by copy.deepcopy(). It records nothing.")
      .def(
          "record",
          [](Simulation& of, const std::filesystem::path& file) {
            requireUsable(of, SimulationAccess::structural);
            of.record(file);
          },
          py::arg("file"),
          "Records the present state and all further steps as an MRPT rawlog, which appears when it is complete.")
      .def(
          "stop_recording",
          [](Simulation& of) {
            requireUsable(of, SimulationAccess::structural);
            of.stopRecording();
          },
          "Completes the recording. Raises RecordingError, such as when the disk is full.")
      .def_property_readonly("is_recording", [](const Simulation& of) { return toRead(of).isRecording(); });
}

void close(Simulation& simulation) {
  if (simulation.isClosed()) return;
  requireUsable(simulation, SimulationAccess::structural);
  simulation.close();
}

}  // namespace

void bindSimulation(py::module_& module) {
  SimulationClass simulation(module, "Simulation",
                             "A run of a world, step by step. The same world, seed, controllers and commands give the "
                             "same run, bit for bit.");
  simulation
      .def(
          py::init(&make), py::arg("world"), py::arg("seed") = kDefaultSeed, py::arg("period_s") = 0.1,
          py::arg("threads") = 1, py::arg("controller") = "", py::arg("controllers") = py::dict(),
          "controller: of all robots: a name as for `robosim run --controller`, or 'none' for robots that are driven "
          "by "
          "commands;\nempty: as given in the world, else gold_finder.\ncontrollers: those of single robots, by name: a "
          "name of a controller, 'none', or an object with step(robot).\nperiod_s: length of a step, (0, 1] s. threads "
          "do "
          "not affect the results.")
      .def_property_readonly(
          "robots", [](const Simulation& of) { return py::tuple(py::cast(toRead(of).environment().fleet().robots)); },
          "The robots, as RobotInfo, in the order of all arrays.")
      .def(
          "plan",
          [](const Simulation& of) {
            return planOf(toRead(of).environment().presentWorld(), of.environment().fleet(),
                          stateOf(of).world_from_robot);
          },
          "Plan from above with the robots at their poses: uint8, shape (height, width, 3): red, green, blue.")
      .def(
          "_repr_svg_",
          [](const Simulation& of) {
            return toPython(
                svgOf(toRead(of).environment().presentWorld(), of.environment().fleet(), stateOf(of).world_from_robot));
          },
          "The plan as an SVG document, which notebooks show.")
      .def("close", close, "Completes the recording, and ends the use of the simulation. Arrays keep their values.")
      .def_property_readonly("closed", &Simulation::isClosed)
      .def("__enter__", [](const SimulationHandle& of) { return of; })
      .def("__exit__", [](Simulation& of, const py::args&) { close(of); })
      .def("__deepcopy__",
           [](const Simulation& of, const py::dict&) {
             requireUsable(of, SimulationAccess::structural);
             return of.fork();
           })
      .def(
          "__reduce__",
          [](const Simulation&) -> py::tuple {
            throw py::type_error(
                "a simulation cannot be pickled, because of its controllers; pickle its World and the bytes of save()");
          })
      .def("__repr__", [](const Simulation& of) {
        if (of.isClosed()) return py::str("<Simulation, closed>");
        const State& state = stateOf(of);
        return toPython("<Simulation of '" + of.environment().world().name + "', step " +
                        std::to_string(state.time.step) + ">");
      });
  bindStepping(simulation);
  bindArrays(simulation);
  bindMessages(simulation);
  bindPictures(simulation);
  bindSaving(simulation);
  bindInterventions(simulation);
}

}  // namespace robosim
