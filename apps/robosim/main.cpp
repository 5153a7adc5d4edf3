#include <iostream>

#include <CLI/CLI.hpp>

#include "base/error_list.h"
#include "robosim/subcommands.h"

namespace {

int fail(robosim::ExitCode code, const std::string& what) {
  std::cout.flush();
  std::cerr << "robosim: " << what << '\n';
  return code;
}

bool hasSubcommand(const CLI::App& program, const std::string& name) {
  return !program.get_subcommands([&](const CLI::App* command) { return command->check_name(name); }).empty();
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App program(
      "RoboSim simulates many sensing, talking, cooperating mobile robots, and keeps their runs as MRPT rawlogs.");
  program.name("robosim");
  program.set_version_flag("--version", "robosim " ROBOSIM_VERSION);
  program.require_subcommand(1);
  program.footer(
      "Try:  robosim run worlds/opho2_1.xml --picture run.png\n"
      "Exit: 0 done, 1 bad input, 2 the run itself failed.");
  robosim::addRun(program);
  robosim::addServe(program);
  robosim::addRobot(program);
  robosim::addRemote(program);
  robosim::addGeometry(program);
  robosim::addControl(program);
  robosim::addView(program);
  robosim::addReplay(program);
  robosim::addCheck(program);
  robosim::addExport(program);
  robosim::addBench(program);

  // CLI11 would call an unknown subcommand a missing one.
  if (const std::string first = argc > 1 ? argv[1] : "-"; first.find('-') != 0 && !hasSubcommand(program, first)) {
    return fail(robosim::kBadInput, "there is no subcommand '" + first + "'; see robosim --help");
  }
  try {
    program.parse(argc, argv);
    std::cout.flush();
    if (!std::cout) return fail(robosim::kRunFailed, "standard output could not be written; is the disk full?");
    return robosim::kDone;
  } catch (const CLI::ParseError& error) {
    // Help and version are no errors; everything else that CLI11 refuses is bad input, whatever its own number for it.
    return program.exit(error) == 0 ? robosim::kDone : robosim::kBadInput;
  } catch (const robosim::Exit& exit) {
    return exit.code;
  } catch (const robosim::ConfigError& error) {
    return fail(robosim::kBadInput, error.what());
  } catch (const std::invalid_argument& error) {
    return fail(robosim::kBadInput, error.what());
  } catch (const std::exception& error) {
    return fail(robosim::kRunFailed, error.what());
  }
}
