#pragma once
#include <array>
#include <string_view>

#include "robosim/cli11_names.h"

namespace robosim {

/// Exit codes of the program.
enum ExitCode {
  kDone = 0,
  kBadInput = 1,
  kRunFailed = 2,
  kIncomplete = 3,  ///< steps were taken without some of the robots, or messages were lost
  kUntrusted = 4,   ///< a geometry worker returned wrong results
};

/// Thrown by a subcommand to end with a given exit code, after it has printed the reason.
struct Exit {
  ExitCode code;
};

/// A subcommand of `robosim`.
struct Subcommand {
  const char* name;
  const char* help;
  const char* part;  ///< the executable for it: robosim-run, robosim-net, robosim-view
};

/// All subcommands, in the order of the help text. They are divided among executables by the libraries that they need,
/// so that each starts fast: robosim-run needs neither gRPC nor a windowing system.
inline constexpr std::array kSubcommands{
    Subcommand{"run", "Run a world in this process", "robosim-run"},
    Subcommand{"serve", "Serve a world to robots, viewers, geometry workers and control panels in other processes",
               "robosim-net"},
    Subcommand{"arcos", "Serve a map to programs of ARIA, as MobileSim does", "robosim-net"},
    Subcommand{"robot", "Run the controllers of robots of a served world", "robosim-net"},
    Subcommand{"remote", "Drive one robot of a team, from a web page or with a joystick", "robosim-net"},
    Subcommand{"geometry",
               "Compute readings of sonars, lasers and infrared sensors for an environment in another process",
               "robosim-net"},
    Subcommand{"control", "Control a served run", "robosim-net"},
    Subcommand{"view", "View a running environment, a recording, a world, or a map", "robosim-view"},
    Subcommand{"replay", "Summarise a recording, print it, extract a part, repeat its run, or feed it to a controller",
               "robosim-run"},
    Subcommand{"check", "Validate a file and summarise it, or list all errors", "robosim-run"},
    Subcommand{"export", "Export a world as a map or plan, or a recording as tables or a figure", "robosim-run"},
    Subcommand{"convert", "Convert a world of Stage to files of RoboSim", "robosim-run"},
    Subcommand{"fit", "Estimate the errors of a laser scanner from a recording of a real robot", "robosim-run"},
    Subcommand{"generate", "Generate a random world: maze, cave, office, open", "robosim-run"},
    Subcommand{"controllers", "List the controllers with their parameters", "robosim-run"},
    Subcommand{"sensors", "List the kinds of sensors with their settings", "robosim-run"},
    Subcommand{"observers", "List the observers of runs with their parameters", "robosim-run"},
    Subcommand{"bench", "Tabulate success rates and metrics of many runs; speed is measured by robosim_bench",
               "robosim-run"},
};

/// `robosim run` with this option is in the executable of `robosim view`.
constexpr std::string_view kViewOption = "--view";
/// With one of these it is in the executable of `robosim serve`.
constexpr std::string_view kFoxgloveOption = "--foxglove";
constexpr std::string_view kRos2Option = "--ros2";

/// The entry of kSubcommands with this name; null when there is none.
const Subcommand* subcommandNamed(std::string_view name);

/// Subcommand::part for the arguments of a program.
const char* partFor(const Subcommand& subcommand, int argc, char** argv);

/// Whether an option is among the arguments of a subcommand, "--option" or "--option=value".
bool hasOption(std::string_view option, int argc, char** argv);

/// Adds all subcommands, without options, for the help text.
void addNames(CLI::App& program);

/// Adds a subcommand of kSubcommands, without options.
/// @return the subcommand, owned by `program`
CLI::App* addSubcommand(CLI::App& program, std::string_view name);

/// @name The subcommands, one file each
/// Each function adds a subcommand with its options to the program. Exceptions determine the exit code: ConfigError and
/// std::invalid_argument for bad input, anything else for a failed run.
///@{
void addRun(CLI::App& program);
void addRunWithWindow(CLI::App& program);  ///< the same, for `robosim run --view`
void addRunWithServer(CLI::App& program);  ///< the same, for `robosim run` with --foxglove or --ros2
void addServe(CLI::App& program);
void addArcos(CLI::App& program);
void addRobot(CLI::App& program);
void addRemote(CLI::App& program);
void addGeometry(CLI::App& program);
void addControl(CLI::App& program);
void addView(CLI::App& program);
void addReplay(CLI::App& program);
void addCheck(CLI::App& program);
void addExport(CLI::App& program);
void addConvert(CLI::App& program);
void addFit(CLI::App& program);
void addGenerate(CLI::App& program);
void addControllers(CLI::App& program);
void addSensors(CLI::App& program);
void addObservers(CLI::App& program);
void addBench(CLI::App& program);
///@}

}  // namespace robosim
