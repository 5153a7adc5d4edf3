#include "generated_world.h"

#include <cmath>
#include <variant>
#include <vector>

#include "base/error_list.h"
#include "generation/generators.h"
#include "python_errors.h"
#include "world/world_file.h"

namespace robosim {
namespace {

namespace py = pybind11;

/// A number of a generator's options, by its name.
struct Option {
  const char* name;
  std::variant<int*, double*> number;
};

void set(const Option& option, const py::handle& value) {
  const bool is_whole = std::holds_alternative<int*>(option.number);
  if (!py::isinstance<py::int_>(value) && (is_whole || !py::isinstance<py::float_>(value))) {
    throw py::type_error(std::string(option.name) + " must be " + (is_whole ? "a whole number" : "a number"));
  }
  const double number = value.cast<double>();
  if (is_whole && std::abs(number) > 1e9) throw py::value_error(std::string(option.name) + " is too large");
  if (is_whole) {
    *std::get<int*>(option.number) = static_cast<int>(number);
  } else {
    *std::get<double*>(option.number) = number;
  }
}

void read(const std::string& kind, const std::vector<Option>& options, const py::dict& given) {
  std::vector<std::string> names;
  for (const auto& option : options) names.emplace_back(option.name);
  for (const auto& [key, value] : given) {
    const std::string name = toBytes(py::str(key));
    bool is_known = false;
    for (const auto& option : options) {
      if (name != option.name) continue;
      set(option, value);
      is_known = true;
    }
    if (!is_known)
      throw py::type_error("a " + kind + " has no option '" + name + "'; its options are " + listed(names));
  }
}

Scenery sceneryOf(const std::string& kind, std::uint64_t seed, const py::dict& given) {
  if (kind == "maze") {
    MazeOptions maze;
    read(kind, {{"columns", &maze.columns}, {"rows", &maze.rows}, {"braid", &maze.braid}, {"cell_m", &maze.cell_m}},
         given);
    return generateMaze(maze, seed);
  }
  if (kind == "cave") {
    CaveOptions cave;
    read(kind, {{"width_m", &cave.width_m}, {"length_m", &cave.length_m}, {"rock", &cave.rock}}, given);
    return generateCave(cave, seed);
  }
  if (kind == "office") {
    OfficeOptions office;
    read(kind, {{"width_m", &office.width_m}, {"length_m", &office.length_m}, {"room_m", &office.room_m}}, given);
    return generateOffice(office, seed);
  }
  if (kind == "open") {
    OpenOptions open;
    read(kind, {{"width_m", &open.width_m}, {"length_m", &open.length_m}, {"clutter", &open.clutter}}, given);
    return generateOpen(open, seed);
  }
  throw ConfigError("there is no generator '" + kind + "'; use maze, cave, office or open");
}

}  // namespace

std::shared_ptr<PythonWorld> generatedWorld(const std::string& kind, std::uint64_t seed, const TeamOptions& team,
                                            const py::dict& options) {
  Scenery scenery = sceneryOf(kind, seed, options);
  const py::gil_scoped_release no_python;
  return PythonWorld::parse(toXml(populated(std::move(scenery), team, seed)), kind + ".xml", seed);
}

}  // namespace robosim
