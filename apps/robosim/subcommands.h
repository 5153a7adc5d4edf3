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

/// The library that a subcommand is in.
enum class SubcommandLibrary {
  main,     ///< needs no library but the engine
  program,  ///< needs MRPT's observations and maps, OpenCV or Cairo
  serving,  ///< also a network
  viewing,  ///< also windows
};

/// A subcommand of `robosim`.
struct Subcommand {
  const char* name;
  const char* help;
  SubcommandLibrary contained_in;
};

/// All subcommands, in the order of the help text. They are divided among libraries by what they need, so that each
/// starts fast.
inline constexpr std::array kSubcommands{
    Subcommand{"run", "Run a world in this process", SubcommandLibrary::main},
    Subcommand{"serve", "Serve a world to robots, viewers, geometry workers and control panels in other processes",
               SubcommandLibrary::serving},
    Subcommand{"arcos", "Serve a map to programs of ARIA, as MobileSim does", SubcommandLibrary::serving},
    Subcommand{"robot", "Run the controllers of robots of a served world", SubcommandLibrary::serving},
    Subcommand{"remote", "Drive one robot of a team, from a web page or with a joystick", SubcommandLibrary::serving},
    Subcommand{"geometry",
               "Compute readings of sonars, lasers and infrared sensors for an environment in another process",
               SubcommandLibrary::serving},
    Subcommand{"control", "Control a served run", SubcommandLibrary::serving},
    Subcommand{"view", "View a running environment, a recording, a world, or a map", SubcommandLibrary::viewing},
    Subcommand{"replay", "Summarise a recording, print it, extract a part, repeat its run, or feed it to a controller",
               SubcommandLibrary::program},
    Subcommand{"check", "Validate a file and summarise it, or list all errors", SubcommandLibrary::main},
    Subcommand{"export", "Export a world as a map or plan, or a recording as tables or a figure",
               SubcommandLibrary::program},
    Subcommand{"convert", "Convert a world of Stage to files of RoboSim", SubcommandLibrary::main},
    Subcommand{"fit", "Estimate the errors of a laser scanner from a recording of a real robot",
               SubcommandLibrary::program},
    Subcommand{"generate", "Generate a random world: maze, cave, office, open", SubcommandLibrary::main},
    Subcommand{"controllers", "List the controllers with their parameters", SubcommandLibrary::main},
    Subcommand{"sensors", "List the kinds of sensors with their settings", SubcommandLibrary::main},
    Subcommand{"observers", "List the observers of runs with their parameters", SubcommandLibrary::main},
    Subcommand{"bench", "Tabulate success rates and metrics of many runs; speed is measured by robosim_bench",
               SubcommandLibrary::program},
};

/// `robosim run` with this option is in the library of `robosim view`.
constexpr std::string_view kViewOption = "--view";
/// With one of these it is in that of `robosim serve`.
constexpr std::string_view kFoxgloveOption = "--foxglove";
constexpr std::string_view kRos2Option = "--ros2";
constexpr std::string_view kWebOption = "--web";

/// The entry of kSubcommands with this name; null when there is none.
const Subcommand* subcommandNamed(std::string_view name);

/// The library for the arguments of a program: that of the subcommand, or for some options of `run` another.
SubcommandLibrary libraryFor(const Subcommand& subcommand, int argc, char** argv);
/// The executable that is linked to a library, or loads it: robosim-run, robosim-net, robosim-view.
const char* partFor(SubcommandLibrary library);

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
void addRunWithServer(CLI::App& program);  ///< the same, for `robosim run` with --foxglove, --ros2 or --web
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
