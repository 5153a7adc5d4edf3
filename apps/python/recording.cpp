#include "recording.h"

#include <filesystem>
#include <string>

#include <pybind11/numpy.h>
#include <pybind11/stl/filesystem.h>

#include "base/data_folders.h"
#include "file_functions.h"
#include "python_errors.h"
#include "python_released.h"

namespace robosim {
namespace {

namespace py = pybind11;

template <typename T>
py::array_t<T> toArray(const std::vector<T>& values) {
  return py::array_t<T>(static_cast<py::ssize_t>(values.size()), values.data());
}

py::array_t<double> makeTable(const std::vector<const RecordedColumn*>& columns, std::size_t rows) {
  py::array_t<double> table({static_cast<py::ssize_t>(rows), static_cast<py::ssize_t>(columns.size())});
  double* out = table.mutable_data();
  for (std::size_t row = 0; row < rows; ++row) {
    for (const auto* column : columns) *out++ = column->number(row);
  }
  return table;
}

/// The arrays of exportRecording()'s .npz file, with texts as lists.
void addSeriesTo(py::dict& arrays, const RecordedSeries& series) {
  const std::string label = series.label;
  const std::size_t rows = series.steps.size();
  std::vector<const RecordedColumn*> numbers;
  py::list names;
  for (const auto& column : series.columns) {
    if (column.kind == RecordedColumn::Kind::text) {
      py::list texts;
      for (std::size_t row = 0; row < rows; ++row) {
        texts.append(toPython(row < column.texts.size() ? column.texts[row] : std::string()));
      }
      arrays[toPython(label + "/" + column.name)] = texts;
    } else {
      numbers.push_back(&column);
      names.append(toPython(column.name));
    }
  }
  if (!numbers.empty()) {
    arrays[toPython(label)] = makeTable(numbers, rows);
    arrays[toPython(label + "/columns")] = names;
  }
  arrays[toPython(label + "/step")] = toArray(series.steps);
  arrays[toPython(label + "/time_s")] = toArray(series.times_s);
}

py::tuple readRawlog(const std::filesystem::path& file) {
  const SeriesOfRecording read = [&] {
    PythonReleased no_python;
    std::uint64_t calls = 0;
    return fileFunctions().read(requireDataFile(file).string(), [&](std::uint64_t) {
      if (++calls % 4096 != 0) return;
      no_python.acquire();
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      no_python.release();
    });
  }();
  py::dict arrays;
  py::dict sensors;  // by robot, in the recording's order
  for (const auto& series : read.series) {
    addSeriesTo(arrays, series);
    const py::str robot = toPython(series.robot);
    if (!sensors.contains(robot)) sensors[robot] = py::list();
    sensors[robot].cast<py::list>().append(toPython(series.sensor));
  }
  py::object damage = py::none();
  if (read.read_error) damage = toPython(*read.read_error);
  return py::make_tuple(arrays, sensors, damage, read.is_damaged);
}

}  // namespace

void bindRecording(py::module_& module) { module.def("_read_rawlog", readRawlog, py::arg("file")); }

}  // namespace robosim
