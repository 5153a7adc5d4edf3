#include "generated_world.h"

#include <cmath>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include <pybind11/stl.h>

#include "base/error_list.h"
#include "python_errors.h"
#include "python_released.h"
#include "world/generation/generators.h"
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
    throw py::type_error(std::string(option.name) + " must be " + (is_whole ? "a whole number" : "a number") +
                         ", not " + py::str(py::type::handle_of(value).attr("__name__")).cast<std::string>() +
                         "; for example " + option.name + "=" + (is_whole ? "6" : "1.5"));
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

/// @throws ConfigError for an unknown kind; pybind11::type_error for an unknown option and a value that is no number
WorldGenerator::MakeScenery sceneryMaker(const std::string& kind, const py::dict& given) {
  if (kind == "maze") {
    MazeOptions maze;
    read(kind, {{"columns", &maze.columns}, {"rows", &maze.rows}, {"braid", &maze.braid}, {"cell_m", &maze.cell_m}},
         given);
    return [maze](std::uint64_t seed) { return generateMaze(maze, seed); };
  }
  if (kind == "cave") {
    CaveOptions cave;
    read(kind, {{"width_m", &cave.width_m}, {"length_m", &cave.length_m}, {"rock", &cave.rock}}, given);
    return [cave](std::uint64_t seed) { return generateCave(cave, seed); };
  }
  if (kind == "office") {
    OfficeOptions office;
    read(kind, {{"width_m", &office.width_m}, {"length_m", &office.length_m}, {"room_m", &office.room_m}}, given);
    return [office](std::uint64_t seed) { return generateOffice(office, seed); };
  }
  if (kind == "open") {
    OpenOptions open;
    read(kind, {{"width_m", &open.width_m}, {"length_m", &open.length_m}, {"clutter", &open.clutter}}, given);
    return [open](std::uint64_t seed) { return generateOpen(open, seed); };
  }
  throw ConfigError("there is no generator '" + kind + "'; use maze, cave, office or open");
}

/// @throws std::invalid_argument
TeamOptions toTeamOptions(int robots, std::vector<std::string> types, std::string controller, bool gold) {
  if (robots < 0 || robots > 1'000'000) {
    throw std::invalid_argument("robots is " + std::to_string(robots) + "; it must be 0 to 1000000, for example 2");
  }
  return {robots, std::move(types), std::move(controller), gold};
}

}  // namespace

PythonGenerator::PythonGenerator(std::string kind, TeamOptions team, const py::dict& options)
    : kind_(std::move(kind)),
      team_(std::move(team)),
      options_(options.attr("copy")()),
      make_(sceneryMaker(kind_, options)) {}

py::tuple PythonGenerator::arguments() const {
  return py::make_tuple(toPython(kind_), team_.robots, team_.models, toPython(team_.controller), team_.has_gold,
                        options_);
}

std::shared_ptr<PythonWorld> PythonGenerator::generate(std::uint64_t seed) const {
  return PythonWorld::parse(toXml(populated(make_(seed), team_, seed)), kind_ + ".xml", seed);
}

WorldGenerator PythonGenerator::forEpisodes() const { return {make_, team_, kind_}; }

void bindGenerator(py::module_& module) {
  py::class_<PythonGenerator, std::shared_ptr<PythonGenerator>>(
      module, "WorldGenerator",
      "Random worlds that differ in their seed only. A VectorEnv or ParallelEnv takes a new one for each episode.\n\n"
      "The arguments are those of World.generate().")
      .def(py::init([](std::string kind, WholeNumber<"robots", int, "0 to 1000000"> robots,
                       std::vector<std::string> types, std::string controller, bool gold, const py::kwargs& options) {
             auto made = std::make_shared<PythonGenerator>(
                 std::move(kind), toTeamOptions(robots, std::move(types), std::move(controller), gold), options);
             made->forEpisodes();  // reports faults
             return made;
           }),
           py::arg("kind"), py::kw_only(), py::arg("robots") = 1, py::arg("types") = kGeneratedTypes,
           py::arg("controller") = "", py::arg("gold") = true)
      .def(
          "generate",
          [](const PythonGenerator& of, Seed seed) {
            const PythonReleased no_python;
            return of.generate(seed);
          },
          py::arg("seed"), "The World of a seed: the same as World.generate(…, seed=seed).")
      .def(py::pickle([](const PythonGenerator& of) { return of.arguments(); },
                      [](const py::tuple& of) {
                        TeamOptions team = toTeamOptions(of[1].cast<int>(), of[2].cast<std::vector<std::string>>(),
                                                         toBytes(of[3].cast<py::str>()), of[4].cast<bool>());
                        return std::make_shared<PythonGenerator>(toBytes(of[0].cast<py::str>()), std::move(team),
                                                                 of[5].cast<py::dict>());
                      }))
      .def("__copy__", [](const std::shared_ptr<PythonGenerator>& of) { return of; })
      .def("__deepcopy__", [](const std::shared_ptr<PythonGenerator>& of, const py::dict&) { return of; })
      .def_property_readonly("kind", [](const PythonGenerator& of) { return toPython(of.kind()); })
      .def("__repr__", [](const PythonGenerator& of) { return toPython("<WorldGenerator '" + of.kind() + "'>"); });
}

std::shared_ptr<PythonWorld> generatedWorld(const std::string& kind, Seed seed,
                                            WholeNumber<"robots", int, "0 to 1000000"> robots,
                                            std::vector<std::string> types, std::string controller, bool gold,
                                            const py::kwargs& options) {
  const PythonGenerator made(kind, toTeamOptions(robots, std::move(types), std::move(controller), gold), options);
  const PythonReleased no_python;
  return made.generate(seed);
}

}  // namespace robosim
