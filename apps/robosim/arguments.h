#pragma once
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "base/file_kind.h"
#include "base/ros_distribution.h"
#include "environment/world_changes.h"
#include "robosim/cli11_names.h"

namespace robosim {

/// @name Titles of groups of options in the help
///@{
constexpr const char* kWorldGroup = "World";
constexpr const char* kRunGroup = "Run";
constexpr const char* kRecordingGroup = "Recording and results";
constexpr const char* kClientsGroup = "Robots and clients in other processes";
constexpr const char* kArcosGroup = "Programs of ARIA";
constexpr const char* kRos2Group = "ROS 2";
constexpr const char* kSecurityGroup = "Connection and security";
constexpr const char* kFigureGroup = "Pictures, videos and figures";
constexpr const char* kGridGroup = "Grids and OctoMaps";
constexpr const char* kSelectionGroup = "Selection";
///@}

/// Accepts a finite number in [low, high].
CLI::Validator numberIn(double low, double high);
/// Accepts a whole number in [low, high].
CLI::Validator wholeNumberIn(int low, int high);
/// Accepts a whole number from 0 to 2^64 - 1; CLI11 alone would turn -1 into the largest.
CLI::Validator seedNumber();
/// The argument type of every world, map, recording and list of robots: replaces the name by requireDataFile()
/// (base/data_folders.h), and recognises its kind by its first bytes.
/// @param taken kinds that the command takes
/// @throws ConfigError as requireDataFile() and requireKind()
CLI::Validator inputFile(const std::vector<FileKind>& taken);
/// Rejects an empty text, as from an unset shell variable.
CLI::Validator fileName();

/// Parses `--speed`: simulated seconds per second; 0 for "max" (unlimited). @throws ConfigError
double speedNumber(const std::string& speed);

/// Adds `--time`, `--step` and `--threads`, common to all commands that run a world.
///@{
void addTime(CLI::App& command, double& time_s, const std::string& help);
void addStep(CLI::App& command, double& period_s);
void addThreads(CLI::App& command, int& threads, const std::string& help);
/// --threads of a command that reads recordings. @param threads unchanged by default
CLI::Option* addReadingThreads(CLI::App& command, int& threads);
///@}
/// Warns on standard error when a time is not a multiple of the time step: the run then ends at the nearest multiple.
void warnOfPartialStep(double time_s, double period_s);
/// Adds `--robot` and `--random-robots`: robots in addition to those of the world.
void addRobotOptions(CLI::App& command, WorldChanges& changes);
/// Adds `--random-starts` and, as its partner, `--start-distance`.
void addRandomStartsOption(CLI::App& command, WorldChanges& changes);
/// Adds `--start-distance`: that of random starts from the gold.
CLI::Option* addStartDistanceOption(CLI::App& command, WorldChanges& changes);
/// Adds `--seed` of a world or a run.
void addSeedOption(CLI::App& command, std::uint64_t& seed, const std::string& help);
/// Adds --ros2-distribution, whose partners depend on the command.
CLI::Option* addDistributionOption(CLI::App& command, RosDistribution& distribution);
/// Adds `--noise`: errors of sensors in addition to those of the world.
void addNoiseOption(CLI::App& command, WorldChanges& changes);

/// Adds `--controller`, which accepts a TypeChoice::text().
/// @param also a further value to accept
CLI::Option* addControllerOption(CLI::App& command, std::string& controller, const std::string& help,
                                 const std::string& also = "");

/// Adds `--observer`, repeatable, which accepts a TypeChoice::text() of an observer.
CLI::Option* addObserverOption(CLI::App& command, std::vector<std::string>& observers, const std::string& help);

/// Adds `--reconnect-timeout SECONDS`: how long a client reconnects after its connection breaks.
void addReconnectTimeout(CLI::App& command, double& reconnect_timeout_s);

/// Accepts a former name of an option, which the help omits.
void acceptFormerName(CLI::App& command, CLI::Option& option, const std::string& name);

/// Rejects arguments of a command that name the same file twice, so that no file is overwritten by another.
/// @param files role of each file in error texts, and its path; empty paths are ignored
/// @throws ConfigError
void refuseSameFile(const std::vector<std::pair<std::string, std::filesystem::path>>& files);

}  // namespace robosim
