#pragma once
#include <functional>
#include <initializer_list>
#include <string>
#include <vector>

#include "robosim/cli11_names.h"

/// @file
/// What all commands have in common: the form of the help, options that depend on others, and errors of arguments.
namespace robosim {

/// Longest line of a help text.
constexpr std::size_t kHelpColumns = 100;
/// Begins the description of a Validator that is a range, for the help.
constexpr char kRangeMark = '\x1e';

/// Sets the form of the help of a program and of subcommands that are added later: options in their groups, with
/// units, ranges, defaults and partners, in lines of at most kHelpColumns.
void setHelpFormat(CLI::App& program);

/// @name Options that have an effect only together with another one
/// Declares the partner of an option: the help names it, and the option is refused without it.
/// @return the option
///@{
CLI::Option* dependsOn(CLI::Option* option, const CLI::Option* partner);
/// One of several partners.
CLI::Option* dependsOn(CLI::Option* option, const std::vector<const CLI::Option*>& partners);
/// @param partner what it requires, as the help names it: "--offscreen FILE.mp4"
/// @param holds evaluated after the arguments were parsed
CLI::Option* dependsOn(CLI::Option* option, const std::string& partner, const std::function<bool()>& holds);
///@}

/// Refuses options that are given without their partners. To be called for the whole program after it was parsed.
/// @throws ConfigError
void checkPartners(const CLI::App& program);

/// An error of arguments.
struct ArgumentError {
  std::string command;  ///< to which they belong: "robosim run"
  std::string text;     ///< empty: none was found
};

/// Finds unknown options and subcommands, with the nearest known name, before the arguments are parsed: they are
/// reported first, because they make other errors.
/// @param all a program with all subcommands, to find the one that has an unknown option; called at most once, and may
/// leave some out
ArgumentError findArgumentError(const CLI::App& program, int argc, char** argv,
                                const std::function<void(CLI::App&)>& add_all);

/// Puts a group title on options that have none yet.
void setGroup(CLI::App& command, const std::string& group, std::initializer_list<const char*> options);

}  // namespace robosim
