#include "python_world.h"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "base/atomic_file.h"
#include "base/data_folders.h"
#include "generated_world.h"
#include "pictures.h"
#include "python_errors.h"
#include "python_released.h"
#include "run/local_run.h"
#include "whole_number.h"
#include "world/world_file.h"

namespace robosim {
namespace {

namespace py = pybind11;
namespace fs = std::filesystem;

std::shared_ptr<PythonWorld> worldOf(WorldSource source, std::uint64_t seed) {
  auto world = std::make_shared<PythonWorld>();
  source.seed = seed;
  world->loaded = loadWorld(source, checkController);
  world->source = std::move(source);
  world->seed = seed;
  return world;
}

/// Maps and robot types are found relative to a world file.
void requireItsFolder(const PythonWorld& world, const fs::path& file) {
  if (world.loaded.world.maps.empty()) return;
  const auto folder = [](const fs::path& of) { return fs::weakly_canonical(fs::absolute(of)).parent_path(); };
  if (folder(file) == folder(world.source.file)) return;
  throw ConfigError(file.string() + ": the world refers to the map " + world.loaded.world.maps.front().file +
                    "; write it into the folder " + folder(world.source.file).string());
}

void write(const PythonWorld& world, const fs::path& file) {
  requireItsFolder(world, file);
  AtomicFile written(file);
  written.write(toXml(world.loaded.world));
  written.finish();
  written.commit();
}

std::vector<mrpt::math::TPose2D> startsOf(const PythonWorld& world) {
  std::vector<mrpt::math::TPose2D> starts;
  for (const auto& robot : world.loaded.fleet.robots) starts.push_back(robot.world_from_start);
  return starts;
}

std::string described(const PythonWorld& world) {
  const auto& of = world.loaded;
  return "<World '" + of.world.name + "', " + std::to_string(of.fleet.robots.size()) + " robots, " +
         std::to_string(of.world.objects.size()) + " objects>";
}

/// The texts of all files that the world was made of, so that another process or machine makes the same world.
py::tuple sourceTextsOf(const PythonWorld& world) {
  const WorldSource& source = world.source;
  py::dict types, files;
  for (const auto& [name, type] : source.robot_types) {
    types[py::bytes(name)] = py::make_tuple(py::bytes(type.file.string()), py::bytes(type.text.value_or("")));
  }
  for (const auto& [name, text] : source.files) files[py::bytes(name)] = py::bytes(text);
  return py::make_tuple(py::bytes(source.file), py::bytes(source.text), types, files, world.seed);
}

std::shared_ptr<PythonWorld> worldOfTexts(const py::tuple& state) {
  WorldSource source;
  source.file = state[0].cast<std::string>();
  source.text = state[1].cast<std::string>();
  for (const auto& [name, type] : state[2].cast<py::dict>()) {
    const auto of_type = type.cast<py::tuple>();
    source.robot_types[name.cast<std::string>()] = {of_type[0].cast<std::string>(), of_type[1].cast<std::string>()};
  }
  for (const auto& [name, text] : state[3].cast<py::dict>()) {
    source.files[name.cast<std::string>()] = text.cast<std::string>();
  }
  return worldOf(std::move(source), state[4].cast<std::uint64_t>());
}

}  // namespace

std::shared_ptr<PythonWorld> PythonWorld::load(const fs::path& file, std::uint64_t seed) {
  return worldOf(readWorldSource(requireDataFile(file)), seed);
}

std::shared_ptr<PythonWorld> PythonWorld::parse(std::string text, const fs::path& file, std::uint64_t seed) {
  return worldOf(completeWorldSource(std::move(text), file), seed);
}

void bindWorld(py::module_& module) {
  const auto parse = [](const py::str& text, const fs::path& folder, const std::string& name, Seed seed) {
    std::string bytes = toBytes(text);
    const PythonReleased no_python;
    return PythonWorld::parse(std::move(bytes), folder / (name + ".xml"), seed);
  };
  py::class_<PythonWorld, std::shared_ptr<PythonWorld>>(
      module, "World",
      "A world with its robots, as read from a file or generated. It does not change.\n\n"
      "A pickle contains the texts of all its files, so that it is the same world in any process.")
      .def_static(
          "load",
          [](const fs::path& file, Seed seed) {
            const PythonReleased no_python;
            return PythonWorld::load(file, seed);
          },
          py::arg("file"), py::arg("seed") = kDefaultSeed,
          "Reads a world file or a map file, which is also found by its name in worlds/ and maps/ of RoboSim and in\n"
          "ROBOSIM_PATH, as on the command line: \"opho2_1\".\n\n"
          "seed determines the places of scattered robots and objects.\n"
          "Raises ConfigError with all faults found, each with file:line.")
      .def_static("parse", parse, py::arg("text"), py::arg("folder") = fs::path("."), py::arg("name") = "world",
                  py::arg("seed") = kDefaultSeed,
                  "Parses the text of a world file, whose maps and included files are relative to folder.")
      .def_static("generate", generatedWorld, py::arg("kind"), py::kw_only(), py::arg("seed") = kDefaultSeed,
                  py::arg("robots") = 1, py::arg("types") = kGeneratedTypes, py::arg("controller") = "",
                  py::arg("gold") = true,
                  "Generates a random world; equal arguments give equal worlds.\n\n"
                  "kind and its options: 'maze' (columns, rows, braid, cell_m), 'cave' (width_m, length_m, rock),\n"
                  "'office' (width_m, length_m, room_m), 'open' (width_m, length_m, clutter).\n"
                  "robots have the robot types in turn and stand far from each other and from the gold.")
      .def_property_readonly("name", [](const PythonWorld& world) { return toPython(world.loaded.world.name); })
      .def_property_readonly(
          "file", [](const PythonWorld& world) { return toPython(world.source.file); },
          "Path of its file, which names it in errors.")
      .def_readonly("seed", &PythonWorld::seed)
      .def_property_readonly(
          "bounds",
          [](const PythonWorld& world) {
            const Bounds2D& bounds = world.loaded.world.bounds;
            return py::make_tuple(bounds.x_min, bounds.x_max, bounds.y_min, bounds.y_max);
          },
          "Area of the surface: x_min, x_max, y_min, y_max [m].")
      .def_property_readonly(
          "robots", [](const PythonWorld& world) { return py::tuple(py::cast(world.loaded.fleet.robots)); },
          "The robots, as RobotInfo, in the world's order.")
      .def_property_readonly(
          "objects", [](const PythonWorld& world) { return py::tuple(py::cast(world.loaded.world.objects)); },
          "The stationary objects, as WorldObject. Walls of maps are not among them.")
      .def("write", write, py::arg("file"), py::call_guard<PythonReleased>(),
           "Writes a world file, with scattered robots and objects at their places. The file appears complete.")
      .def(
          "to_xml", [](const PythonWorld& world) { return toPython(toXml(world.loaded.world)); },
          "Text of the file that write() writes.")
      .def(
          "plan",
          [](const PythonWorld& world) { return planOf(world.loaded.world, world.loaded.fleet, startsOf(world)); },
          "Plan from above with the robots at their starts: uint8, shape (height, width, 3): red, green, blue.")
      .def(
          "_repr_svg_",
          [](const PythonWorld& world) {
            return toPython(svgOf(world.loaded.world, world.loaded.fleet, startsOf(world)));
          },
          "The plan as an SVG document, which notebooks show.")
      .def(py::pickle(&sourceTextsOf, &worldOfTexts))
      .def("__copy__", [](const std::shared_ptr<PythonWorld>& world) { return world; })
      .def("__deepcopy__", [](const std::shared_ptr<PythonWorld>& world, const py::dict&) { return world; })
      .def("__repr__", [](const PythonWorld& world) { return toPython(described(world)); });
}

}  // namespace robosim
