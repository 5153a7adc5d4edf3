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

}  // namespace robosim
