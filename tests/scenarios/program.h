#pragma once
#include <filesystem>
#include <string>

namespace robosim {

/// What a run of the program left behind.
struct Ended {
  int exit_code = -1;
  std::string out;
  std::string err;
};

/// Runs `robosim ARGUMENTS` (through the shell, from the project's folder) to its end.
Ended runProgram(const std::string& arguments);

/// A new, empty folder of the running test's own.
std::filesystem::path emptyFolder();

std::string textOf(const std::filesystem::path& file);

}  // namespace robosim
