// The extension module robosim._robosim. robosim/__init__.py is its public face.
#include <pybind11/pybind11.h>
#include <pybind11/stl/filesystem.h>

#include "batch.h"
#include "generated_world.h"
#include "python_errors.h"
#include "python_released.h"
#include "python_robot.h"
#include "python_world.h"
#include "recording.h"
#include "run/loaded_parts.h"
#include "run/plugin.h"
#include "simulation.h"

PYBIND11_MODULE(_robosim, module) {
  namespace py = pybind11;
  module.attr("__version__") = ROBOSIM_VERSION;
  robosim::useLoadedParts();
  robosim::registerErrors();
  module.def("load_plugin", &robosim::loadPlugin, py::arg("file"),
             "Loads a plugin with additional controllers and sensors (doc/sdk.md). Raises ConfigError.");
  robosim::bindDescriptions(module);
  robosim::bindWorld(module);
  robosim::bindGenerator(module);
  robosim::bindRobot(module);
  robosim::bindSimulation(module);
  robosim::bindBatch(module);
  robosim::bindRecording(module);
  robosim::explainArguments(module);
  robosim::refuseUnconstructed(module);
  robosim::registerPythonEnd(module);
}
