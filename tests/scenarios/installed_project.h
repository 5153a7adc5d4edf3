#pragma once
#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string>

#include "base/temporary_directory.h"
#include "tests/scenarios/program.h"
#include "tests/scenarios/verifying.h"

namespace robosim {

/// An installation of RoboSim in a temporary folder, with one of the example projects in doc/examples built against it:
/// without optimisation and with the files of a target compiled together, which takes a quarter of the time. ./dev
/// verify suites compiles each alone, as a user does.
class InstalledProject {
 public:
  /// @param change called with the project's folder before the build
  /// @throws std::runtime_error with the output when the installation or the build fails
  explicit InstalledProject(std::string example, const std::function<void(const std::filesystem::path&)>& change = {})
      : example_(std::move(example)) {
    for (const std::string component : {"robosim", "robosim-dev"}) {
      succeed(ROBOSIM_CMAKE " --install '" ROBOSIM_BUILD_DIR "' --component " + component + " --prefix " +
              quoted(prefix()));
    }
    std::filesystem::copy(ROBOSIM_SOURCE_DIR "/doc/examples/" + example_, folder(),
                          std::filesystem::copy_options::recursive);
    if (change) change(folder());
    succeed(ROBOSIM_CMAKE " -S " + quoted(folder()) + " -B " + quoted(folder() / "build") +
            " -DCMAKE_CXX_FLAGS_RELEASE=-O0 -DCMAKE_UNITY_BUILD=" + (isVerifying() ? "OFF" : "ON") +
            " -DCMAKE_PREFIX_PATH=" + quoted(prefix()) + " && " ROBOSIM_CMAKE " --build " + quoted(folder() / "build"));
  }

  std::filesystem::path folder() const { return temporary_ / example_; }
  /// The installed program.
  std::filesystem::path program() const { return prefix() / "bin" / "robosim"; }
  /// Built shared library of a plugin.
  std::filesystem::path library(const std::string& plugin) const {
    return folder() / "build" / ("lib" + plugin + ".so");
  }
  /// Runs the installed program in the project's folder.
  /// @param input command whose output is the program's standard input: "printf x"; empty for no input
  Ended run(const std::string& arguments, const std::string& input = "") const {
    // In parentheses, because runCommand() redirects the input of the last command.
    return runCommand("(cd " + quoted(folder()) + " && " + (input.empty() ? "" : input + " | ") + quoted(program()) +
                      " " + arguments + ")");
  }

 private:
  std::filesystem::path prefix() const { return temporary_ / "prefix"; }
  static void succeed(const std::string& command) {
    const Ended ended = runCommand(command);
    if (ended.exit_code != 0) throw std::runtime_error(command + ": " + ended.out + ended.err);
  }

  std::string example_;
  TemporaryDirectory temporary_;
};

}  // namespace robosim
