#pragma once
#include <string>

#include <pybind11/pybind11.h>

namespace robosim {

/// Class of robosim/_errors.py.
pybind11::object errorClass(const char* name);

/// Text of any bytes, as Python converts the names of files: bytes that are not UTF-8 become lone surrogates.
pybind11::str toPython(const std::string& bytes);

/// Bytes of a text that toPython() or Python made.
std::string toBytes(const pybind11::str& text);

/// Converts RoboSim's exceptions to those of robosim/_errors.py.
void registerErrors();
/// Makes the TypeErrors of all functions and classes of the module name the argument, what it must be, and an example.
/// To be called when all are bound.
void explainArguments(pybind11::module_& module);

/// Makes every use of an object whose constructor has not been called (`Simulation.__new__(Simulation).poses`) raise
/// TypeError. pybind11 would use memory that is not initialised. To be called when the module has its classes.
void refuseUnconstructed(pybind11::module_& module);

}  // namespace robosim
