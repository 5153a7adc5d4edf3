// The command `robosim`: starts the executable that contains the requested subcommand. It links no library of its own,
// so that --help, --version and errors appear at once.
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <string_view>

#include <CLI/CLI.hpp>
#include <unistd.h>

#include "base/program_folder.h"
#include "robosim/program.h"
#include "robosim/subcommands.h"

namespace robosim {
namespace {

/// Replaces this process by another executable: beside it in a build tree, in ../libexec/robosim when installed.
int start(const char* part, char** argv) {
  try {
    const auto folder = programFolder();
    const auto beside = folder / part;
    const auto installed = folder.parent_path() / "libexec" / "robosim" / part;
    std::error_code none;
    const auto file = std::filesystem::exists(beside, none) ? beside : installed;
    execv(file.c_str(), argv);
    const int error = errno;
    std::cerr << "robosim: cannot start " << file.string() << ": " << std::strerror(error);
    if (error == ENOENT) std::cerr << "; there is no " << beside.string() << " either";
    if (part == std::string_view("robosim-view")) std::cerr << "; the portable archive has no windows";
    std::cerr << "; install RoboSim again\n";
  } catch (const std::exception& error) {
    std::cerr << "robosim: " << error.what() << '\n';
  }
  return kRunFailed;
}

}  // namespace
}  // namespace robosim

int main(int argc, char** argv) {
  robosim::replaceHelpSubcommand(argc, argv);
  const robosim::Subcommand* subcommand = argc > 1 ? robosim::subcommandNamed(argv[1]) : nullptr;
  if (subcommand) return robosim::start(robosim::partFor(robosim::libraryFor(*subcommand, argc, argv)), argv);
  return robosim::executeRobosim({robosim::addNames}, argc, argv);
}
