#include "python_robot.h"

#include <variant>

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include "array_arguments.h"
#include "base/error_list.h"
#include "pictures.h"
#include "python_errors.h"

namespace robosim {
namespace {

namespace py = pybind11;

std::string labelsOf(const Robot& robot) {
  std::vector<std::string> labels;
  for (const auto& sensor : *robot.info().sensors) labels.push_back(sensor.label);
  return listed(labels);
}

/// Measurement of the first sensor of a kind, otherwise of the sensor with a label; null for a robot without it.
/// @throws std::invalid_argument for a name that is neither
const Measurement* measurementNamed(const Robot& robot, const std::string& name) {
  if (const auto kind = sensorKindNamed(name)) {
    if (const Measurement* of_kind = robot.measurement(*kind)) return of_kind;
  }
  const Measurement* of_label = robot.measurement(name);
  if (of_label || sensorKindNamed(name)) return of_label;
  throw std::invalid_argument("robot '" + robot.name() + "' has no sensor with the label '" + name +
                              "', which is no kind of sensor either; its sensors are " + labelsOf(robot));
}

/// The picture of a camera, which may be empty; null for a robot without it.
const Image* imageNamed(const Robot& robot, const std::string& sensor) {
  const Measurement* measurement = measurementNamed(robot, sensor);
  if (!measurement) return nullptr;
  const auto* image = std::get_if<Image>(measurement);
  if (!image) throw std::invalid_argument("a " + sensor + " takes no pictures; name a camera, such as 'camera'");
  return image;
}

/// Ranges of the first sensor of a kind; None for a robot without it.
py::object rangesOf(const PythonRobot& robot, SensorKind kind) {
  const Measurement* measurement = robot.toRead().measurement(kind);
  if (!measurement) return py::none();
  if (const auto* beacons = std::get_if<BeaconRanges>(measurement)) {
    return py::array_t<float>(static_cast<py::ssize_t>(beacons->range_m.size()), beacons->range_m.data());
  }
  const auto* echoes = std::get_if<Echoes>(measurement);
  if (!echoes) throw std::invalid_argument(std::string("a ") + nameOf(kind) + " measures no ranges");
  py::array_t<float> ranges(static_cast<py::ssize_t>(echoes->size()));
  float* out = ranges.mutable_data();
  for (const Echo& echo : *echoes) *out++ = echo.range_m;
  return ranges;
}

py::object pointsOf(const PythonRobot& robot, const std::string& kind) {
  const Measurement* measurement = measurementNamed(robot.toRead(), kind);
  if (!measurement) return py::none();
  const auto* echoes = std::get_if<Echoes>(measurement);
  if (!echoes) throw std::invalid_argument("a " + kind + " has no echoes");
  py::array_t<float> points({static_cast<py::ssize_t>(echoes->size()), py::ssize_t{3}});
  float* out = points.mutable_data();
  for (const Echo& echo : *echoes) {
    for (const float coordinate : {echo.point_m.x, echo.point_m.y, echo.point_m.z}) *out++ = coordinate;
  }
  return points;
}

py::object readingsOfSensor(const PythonRobot& robot, const std::string& sensor) {
  const Robot& of = robot.toRead();
  if (sensor != "stalled" && sensor != "pose" && !measurementNamed(of, sensor)) return py::none();
  return robot.readings(sensor);
}

py::object bumperOf(const PythonRobot& robot) {
  const Robot& of = robot.toRead();
  if (!of.sensor(SensorKind::bumper)) return py::none();
  py::array_t<bool> pressed(static_cast<py::ssize_t>(of.bumper().size()));
  std::copy(of.bumper().begin(), of.bumper().end(), pressed.mutable_data());
  return pressed;
}

py::object imageOf(const PythonRobot& robot) { return pictureOf(robot.toRead().image()); }

py::object imageOfSensor(const PythonRobot& robot, const std::string& sensor) {
  return robotImage(robot.toRead(), sensor);
}

py::object depthOf(const PythonRobot& robot, const std::string& sensor) {
  const Image* image = imageNamed(robot.toRead(), sensor);
  return image ? depthsOf(*image) : py::object(py::none());
}

py::object identityOf(const PythonRobot& robot, const std::string& sensor) {
  const Image* image = imageNamed(robot.toRead(), sensor);
  return image ? identitiesOf(*image) : py::object(py::none());
}

py::object valuesOf(const PythonRobot& robot) {
  const Robot& of = robot.toRead();
  const SensorInfo* sensor = of.sensor(SensorKind::values);
  if (!sensor) return py::none();
  const auto& values = std::get<Values>(*of.measurement(SensorKind::values)).values;
  py::dict named;
  for (std::size_t i = 0; i < values.size(); ++i) named[toPython(sensor->quantities[i].name)] = values[i];
  return named;
}

void drive(const PythonRobot& robot, double speed_mps, double turn_radps, double lateral_mps) {
  requireFinite("the speed", speed_mps);
  requireFinite("the turn rate", turn_radps);
  requireFinite("the lateral speed", lateral_mps);
  robot.toCommand().drive(speed_mps, turn_radps, lateral_mps);
}

void panLaser(const PythonRobot& robot, double pan_rad) {
  requireFinite("the pan angle", pan_rad);
  robot.toCommand().panLaser(pan_rad);
}

void aimCamera(const PythonRobot& robot, double pan_rad, double tilt_rad) {
  requireFinite("the pan angle", pan_rad);
  requireFinite("the tilt angle", tilt_rad);
  robot.toCommand().aimCamera(pan_rad, tilt_rad);
}

void zoomCamera(const PythonRobot& robot, double zoom) {
  requireFinite("the zoom", zoom);
  robot.toCommand().zoomCamera(zoom);
}

void limitCameraSpeed(const PythonRobot& robot, double pan_radps, double tilt_radps) {
  requireFinite("the pan speed", pan_radps);
  requireFinite("the tilt speed", tilt_radps);
  robot.toCommand().limitCameraSpeed(pan_radps, tilt_radps);
}

py::object cameraAimOf(const PythonRobot& robot) {
  const Robot& of = robot.toRead();
  if (!of.cameraHead()) return py::none();
  const CameraAim aim = of.cameraAim();
  return py::make_tuple(aim.pan_rad, aim.tilt_rad, aim.zoom);
}

py::list nameList(const std::vector<std::string>& names) {
  py::list list;
  for (const auto& name : names) list.append(toPython(name));
  return list;
}

using RobotClass = py::class_<PythonRobot>;

void bindReadings(RobotClass& robot) {
  for (const SensorKind kind : {SensorKind::sonar, SensorKind::laser, SensorKind::infrared, SensorKind::beacons}) {
    robot.def_property_readonly(
        nameOf(kind), [kind](const PythonRobot& of) { return rangesOf(of, kind); },
        "Range of each beam or beacon [m]: float32, shape (beams,); the sensor's no_echo_m without an echo. None "
        "without such a sensor.");
  }
  robot
      .def("points", pointsOf, py::arg("kind"),
           "Echoes of the first sensor of a kind, or of the sensor with this label, robot frame [m]: float32, shape "
           "(beams, 3). None without one.")
      .def("readings", readingsOfSensor, py::arg("sensor"),
           "Values of the first sensor of a kind, or of the sensor with this label, as Simulation.readings(): float32, "
           "shape (values,). None without one.")
      .def_property_readonly(
          "heat", [](const PythonRobot& of) { return of.toRead().heat(); }, "[°C]; None without a sensor.")
      .def_property_readonly(
          "compass", [](const PythonRobot& of) { return of.toRead().compass(); },
          "Heading [rad], world frame, in (-π, π]; None without a sensor.")
      .def_property_readonly(
          "battery", [](const PythonRobot& of) { return of.toRead().battery(); }, "[V]; None without a sensor.")
      .def_property_readonly("bumper", bumperOf, "Whether each segment is pressed: bool, shape (segments,), or None.")
      .def_property_readonly(
          "odometry",
          [](const PythonRobot& of) {
            const Odometry& odometry = of.toRead().odometry();
            const auto& pose = odometry.odom_from_robot;
            return py::make_tuple(pose.x, pose.y, pose.phi, odometry.speed_mps, odometry.turn_radps);
          },
          "x, y [m] and heading [rad] since the start, speed [m/s], turn rate [rad/s].")
      .def_property_readonly(
          "image", imageOf,
          "Picture of the first camera: uint8, shape (height, width, 3): red, green, blue; None in a step without one.")
      .def(
          "depth_of", depthOf, py::arg("sensor") = "camera",
          "Distances [m] along the optical axis in the picture of a ray-cast camera: float32, shape (height, width); 0 "
          "where\nnothing is within the camera's range. None without depths, and in a step without a picture.")
      .def("identity_of", identityOf, py::arg("sensor") = "camera",
           "What each pixel of a ray-cast camera shows: uint32, shape (height, width): the index of an object, or the "
           "number of\nobjects + the index of a robot; 2**32 - 1 for the sky, - 2 for the floor, - 3 for a map's wall.")
      .def("image_of", imageOfSensor, py::arg("sensor"),
           "Picture of the camera with this label: uint8, shape (height, width, 3): red, green, blue, the first row at "
           "the top. None in a step without one.")
      .def_property_readonly("values", valuesOf, "Quantities of a sensor of a plugin by name; None without one.")
      .def_property_readonly(
          "lateral_mps", [](const PythonRobot& of) { return of.toRead().odometry().lateral_mps; },
          "Speed to the left [m/s], by odometry; 0 of most drives.")
      .def_property_readonly(
          "stalled", [](const PythonRobot& of) { return of.toRead().stalled(); },
          "Whether an obstacle stopped the last motion.")
      .def_property_readonly(
          "inbox", [](const PythonRobot& of) { return inboxOf(of.toRead().readings()); },
          "Messages received in the last step, as Message(sender, text).")
      .def_property_readonly(
          "winner", [](const PythonRobot& of) { return toPython(of.toRead().winner()); },
          "Name of the robot that has won; empty until then.")
      .def_property_readonly(
          "held", [](const PythonRobot& of) { return of.toRead().held(); },
          "Whether the gripper holds an object; False for a robot without one.")
      .def_property_readonly("camera_aim", cameraAimOf,
                             "Pan [rad], tilt [rad] and zoom of the camera in this step; None for a robot without one "
                             "that pans, tilts and zooms.")
      .def_property_readonly(
          "leds", [](const PythonRobot& of) { return py::tuple(py::cast(of.toRead().leds())); },
          "Colour of its LEDs: red, green and blue, each in [0, 1]; (0, 0, 0) is off.");
}

void bindCommands(RobotClass& robot) {
  robot
      .def(
          "drive", drive, py::arg("speed_mps"), py::arg("turn_radps"), py::arg("lateral_mps") = 0.0,
          "Sets speed (ahead), turn rate (counter-clockwise) and lateral speed (to the left), which are kept until the "
          "next call.\n\nOnly a robot with an omnidirectional drive has a lateral speed; ValueError for others.")
      .def(
          "stop", [](const PythonRobot& of) { of.toCommand().stop(); }, "The same as drive(0, 0).")
      .def("pan_laser", panLaser, py::arg("pan_rad"), "Turns the sensors that pan: [-π/2, π/2].")
      .def(
          "grip", [](const PythonRobot& of) { of.toCommand().grip(); },
          "Closes the gripper: from the next step on it holds the object between its paddles, if there is one.")
      .def(
          "release", [](const PythonRobot& of) { of.toCommand().release(); },
          "Opens the gripper: what it held stays where it is.")
      .def(
          "set_leds", [](const PythonRobot& of, const std::array<float, 3>& color) { of.toCommand().setLeds(color); },
          py::arg("color"), "Sets the colour of its LEDs: red, green and blue, each in [0, 1]; (0, 0, 0) is off.")
      .def("aim_camera", aimCamera, py::arg("pan_rad"), py::arg("tilt_rad"),
           "Turns a camera that pans and tilts, relative to its mount: to the left, and up.")
      .def("zoom_camera", zoomCamera, py::arg("zoom"),
           "Divides the field of view of a camera that zooms by this: at least 1.")
      .def("limit_camera_speed", limitCameraSpeed, py::arg("pan_radps"), py::arg("tilt_radps"),
           "Limits the speeds of aim_camera(); 0 or less: as fast as the camera can.")
      .def(
          "stop_camera", [](const PythonRobot& of) { of.toCommand().stopCamera(); }, "Aims the camera where it is now.")
      .def(
          "halt",
          [](const PythonRobot& of, bool found) { of.toCommand().halt(found ? Activity::found : Activity::halted); },
          py::arg("found") = false, "Stops permanently; found reports that the robot has found its target.")
      .def(
          "send",
          [](const PythonRobot& of, const py::str& receiver, const py::str& text) {
            of.toCommand().send(toBytes(receiver), toBytes(text));
          },
          py::arg("receiver"), py::arg("text"), "Sends a message of at most 4096 bytes, delivered in the next step.")
      .def(
          "broadcast", [](const PythonRobot& of, const py::str& text) { of.toCommand().broadcast(toBytes(text)); },
          py::arg("text"), "Sends a message to every other robot.")
      .def(
          "check_win", [](const PythonRobot& of) { of.toCommand().checkWin(); },
          "Requests, with the next step, a decision whether this robot is near enough to the gold; then winner is its "
          "name.");
}

}  // namespace

py::object robotImage(const Robot& robot, const std::string& sensor) {
  const Image* image = imageNamed(robot, sensor);
  return image ? pictureOf(*image) : py::object(py::none());
}

PythonRobot::PythonRobot(Simulation& simulation, std::size_t index)
    : simulation_(simulation.weak_from_this()), index_(index), may_command_(simulation.isDrivenFromPython(index)) {}

Robot& PythonRobot::toRead() const {
  const auto simulation = simulation_.lock();
  if (!simulation) throw std::invalid_argument("the robot's simulation no longer exists; keep a reference to it");
  requireUsable(*simulation, SimulationAccess::read);
  return simulation->robot(index_);  // exists as long as the simulation, which the caller's Python objects keep
}

py::array PythonRobot::readings(const std::string& sensor) const {
  const auto simulation = simulation_.lock();
  const ObservationLayout layout(simulation->robot(index_).info(), {sensor});
  py::array_t<float> values(static_cast<py::ssize_t>(layout.size()));
  layout.write(simulation->environment().state(), index_, {values.mutable_data(), layout.size()});
  return values;
}

Robot& PythonRobot::toCommand() const {
  Robot& robot = toRead();
  if (may_command_) return robot;
  throw std::invalid_argument("robot '" + robot.name() +
                              "' has a controller, which commands it; give it the controller '" + kNoController + "'");
}

py::list inboxOf(const Readings& readings) {
  const py::object message = py::module_::import("robosim.controller").attr("Message");
  py::list inbox;
  for (const auto& of : readings.inbox) inbox.append(message(toPython(of.from), toPython(of.text)));
  return inbox;
}

void bindRobot(py::module_& module) {
  RobotClass robot(module, "Robot",
                   "A robot as its controller sees it: readings of the last step, and commands for the next one.\n\n"
                   "Arrays are copies. Sensor properties are of the first sensor of that kind.");
  robot.def_property_readonly("name", [](const PythonRobot& of) { return toPython(of.toRead().name()); })
      .def_property_readonly(
          "time_s", [](const PythonRobot& of) { return of.toRead().time(); }, "Simulated time [s] since the start.")
      .def_property_readonly("step_count", [](const PythonRobot& of) { return of.toRead().stepNumber(); })
      .def_property_readonly(
          "neighbour", [](const PythonRobot& of) { return toPython(of.toRead().info().neighbour); },
          "As given in the world; empty for none.")
      .def_property_readonly("radius_m", [](const PythonRobot& of) { return of.toRead().info().radius_m; })
      .def_property_readonly("speed_max_mps",
                             [](const PythonRobot& of) { return of.toRead().info().type->limits.speed_max_mps; })
      .def_property_readonly("turn_max_radps",
                             [](const PythonRobot& of) { return of.toRead().info().type->limits.turn_max_radps; })
      .def_property_readonly(
          "lateral_max_mps", [](const PythonRobot& of) { return of.toRead().info().type->limits.lateral_max_mps; },
          "Of an omnidirectional drive; 0 for others.")
      .def_property_readonly(
          "drive_type", [](const PythonRobot& of) { return nameOf(of.toRead().info().type->drive.kind); },
          "'differential', 'omni', 'car' or 'tracked'.")
      .def_property_readonly(
          "sensors", [](const PythonRobot& of) { return py::tuple(py::cast(*of.toRead().info().sensors)); },
          "Its sensors, as SensorInfo.")
      .def(
          "robots", [](const PythonRobot& of) { return nameList(of.toRead().robots()); },
          "Names of all robots in the world's order, including this one.")
      .def("__repr__", [](const PythonRobot& of) { return toPython("<Robot '" + of.toRead().name() + "'>"); });
  bindReadings(robot);
  bindCommands(robot);
}

}  // namespace robosim
