// Descriptions of robots, sensors and objects of a world, which Python can read but not change.
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "python_errors.h"
#include "python_world.h"
#include "robots/fleet.h"

namespace robosim {
namespace {

namespace py = pybind11;

py::tuple poseTuple(const mrpt::math::TPose2D& pose) { return py::make_tuple(pose.x, pose.y, pose.phi); }

/// Direction of each beam in the plane [rad], robot frame.
py::array_t<double> bearingsOf(const SensorInfo& sensor) {
  py::array_t<double> bearings(static_cast<py::ssize_t>(sensor.beams.size()));
  auto bearing = bearings.mutable_unchecked<1>();
  for (std::size_t i = 0; i < sensor.beams.size(); ++i) {
    bearing(static_cast<py::ssize_t>(i)) = sensor.beams[i].robot_from_beam.yaw;
  }
  return bearings;
}

void bindSensorInfo(py::module_& module) {
  py::class_<SensorInfo>(module, "SensorInfo", "A sensor mounted on a robot.")
      .def_property_readonly(
          "kind", [](const SensorInfo& sensor) { return nameOf(sensor.kind); }, "Such as 'sonar' or 'heat'.")
      .def_readonly("label", &SensorInfo::label, "Unique on its robot: 'sonar', 'laser_2'.")
      .def_property_readonly(
          "size", [](const SensorInfo& sensor) { return sensor.beams.size(); }, "Number of beams or segments.")
      .def_property_readonly("bearings_rad", bearingsOf,
                             "Direction of each beam in the plane [rad], robot frame, counter-clockwise from ahead: "
                             "float64, shape (size,).")
      .def_readonly("range_min_m", &SensorInfo::range_min_m, "Smallest range that is reported [m].")
      .def_readonly("range_max_m", &SensorInfo::range_max_m, "Largest range [m].")
      .def_readonly("no_echo_m", &SensorInfo::no_echo_m, "Reading of a beam without an echo [m].")
      .def_readonly("beam_width_rad", &SensorInfo::beam_width_rad,
                    "Full opening angle of a beam [rad]; 0 for a thin ray. Of a bumper: width of a segment.")
      .def_readonly("noise_std_m", &SensorInfo::noise_std_m,
                    "Largest standard deviation of a range [m]; 0 without noise.")
      .def_readonly("bearing_std_rad", &SensorInfo::bearing_std_rad,
                    "Range and bearing: standard deviation of a bearing [rad]; 0 without noise.")
      .def_property_readonly(
          "rate_hz", [](const SensorInfo& sensor) { return sensor.times.rate_hz; },
          "Measurements per second of simulated time, at most one per step; 0: one in every step. Between them the "
          "sensor keeps its reading. Of a camera 0: it has a rate of its own.")
      .def_property_readonly(
          "phase_s", [](const SensorInfo& sensor) { return sensor.times.phase_s; },
          "Time of a measurement of a sensor with rate_hz [s], modulo the period.")
      .def_property_readonly(
          "image_shape",
          [](const SensorInfo& sensor) -> py::object {
            if (sensor.camera.width_px == 0) return py::none();
            return py::make_tuple(sensor.camera.height_px, sensor.camera.width_px, 3);
          },
          "Of a camera or blob finder: shape of a picture (height, width, 3); None of other sensors.")
      .def_property_readonly(
          "field_of_view_rad", [](const SensorInfo& sensor) { return sensor.camera.field_of_view_rad; },
          "Of a camera or blob finder: horizontal field of view [rad]; 0 of other sensors.")
      .def_property_readonly(
          "image_rate_hz", [](const SensorInfo& sensor) { return sensor.camera.rate_hz; },
          "Of a camera or blob finder: pictures per second of simulated time; 0 of other sensors.")
      .def_property_readonly(
          "image_layers", [](const SensorInfo& sensor) { return py::tuple(py::cast(sensor.camera.layers.names())); },
          "Of a ray-cast camera: what its pictures contain, some of 'rgb', 'depth', 'identity'; () of other sensors.")
      .def_property_readonly(
          "value_names",
          [](const SensorInfo& sensor) {
            py::list names;
            for (const Quantity& quantity : sensor.quantities) names.append(toPython(quantity.name));
            return py::tuple(names);
          },
          "Of a sensor of kind 'values': name of each number; else ().")
      .def("__repr__", [](const SensorInfo& sensor) {
        return "<SensorInfo '" + sensor.label + "', " + std::to_string(sensor.beams.size()) + " beams>";
      });
}

void bindRobotInfo(py::module_& module) {
  py::class_<FleetRobot>(module, "RobotInfo", "A robot as placed in a world.")
      .def_property_readonly("name", [](const FleetRobot& robot) { return toPython(robot.info.name); })
      .def_property_readonly(
          "type", [](const FleetRobot& robot) { return toPython(robot.info.type->model); },
          "Name of its type; '2005' for a robot that its world file describes.")
      .def_property_readonly(
          "controller", [](const FleetRobot& robot) { return toPython(*robot.controller); },
          "As given in the world, with parameters; empty: the default.")
      .def_property_readonly(
          "start", [](const FleetRobot& robot) { return poseTuple(robot.world_from_start); },
          "x, y [m] and heading [rad], world frame.")
      .def_property_readonly(
          "radius_m", [](const FleetRobot& robot) { return robot.info.radius_m; }, "Of its circular footprint.")
      .def_property_readonly("height_m", [](const FleetRobot& robot) { return robot.info.height_m; })
      .def_property_readonly("speed_max_mps",
                             [](const FleetRobot& robot) { return robot.info.type->limits.speed_max_mps; })
      .def_property_readonly("turn_max_radps",
                             [](const FleetRobot& robot) { return robot.info.type->limits.turn_max_radps; })
      .def_property_readonly("lateral_max_mps",
                             [](const FleetRobot& robot) { return robot.info.type->limits.lateral_max_mps; })
      .def_property_readonly("drive_type", [](const FleetRobot& robot) { return nameOf(robot.info.type->drive.kind); })
      .def_property_readonly(
          "sensors", [](const FleetRobot& robot) { return py::tuple(py::cast(*robot.info.sensors)); },
          "Its sensors, as SensorInfo.")
      .def("__repr__", [](const FleetRobot& robot) {
        return toPython("<RobotInfo '" + robot.info.name + "', " + robot.info.type->model + ">");
      });
}

void bindObject(py::module_& module) {
  py::class_<WorldObject>(module, "WorldObject", "An object of a world.")
      .def_property_readonly("name", [](const WorldObject& object) { return toPython(object.name); })
      .def_property_readonly(
          "shape",
          [](const WorldObject& object) {
            return std::holds_alternative<Cylinder>(object.body.shape) ? "cylinder" : "cube";
          },
          "'cylinder' or 'cube'.")
      .def_property_readonly(
          "pose", [](const WorldObject& object) { return poseTuple(object.body.world_from_body); },
          "x, y [m] of its centre and direction [rad], world frame.")
      .def_property_readonly(
          "size_m",
          [](const WorldObject& object) {
            if (const auto* box = std::get_if<Cube>(&object.body.shape)) {
              return py::make_tuple(box->length_m, box->width_m);
            }
            const double width_m = 2 * std::get<Cylinder>(object.body.shape).radius_m;
            return py::make_tuple(width_m, width_m);
          },
          "Extent along its x and y axes [m].")
      .def_property_readonly("height_m", [](const WorldObject& object) { return object.body.height_m; })
      .def_property_readonly(
          "color", [](const WorldObject& object) { return py::tuple(py::cast(object.body.color)); },
          "Red, green and blue, each in [0, 1].")
      .def_property_readonly(
          "heat_celsius", [](const WorldObject& object) { return object.body.heat_celsius; },
          "Its temperature; 0 gives off no heat.")
      .def_property_readonly(
          "light_cd", [](const WorldObject& object) { return object.body.light_cd; },
          "Its luminous intensity in all directions [cd]; 0: no light.")
      .def_property_readonly(
          "fiducial", [](const WorldObject& object) { return static_cast<int>(object.body.fiducial); },
          "Number of its fiducial mark; 0: it has none.")
      .def_property_readonly(
          "mass_kg",
          [](const WorldObject& object) {
            return object.movable ? std::optional(object.movable->mass_kg) : std::nullopt;
          },
          "Its mass, if robots push it; None for a stationary one.")
      .def("__repr__", [](const WorldObject& object) { return toPython("<WorldObject '" + object.name + "'>"); });
}

}  // namespace

void bindDescriptions(py::module_& module) {
  bindSensorInfo(module);
  bindRobotInfo(module);
  bindObject(module);
}

}  // namespace robosim
