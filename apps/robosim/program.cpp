#include "robosim/program.h"

#include <algorithm>
#include <csignal>
#include <iostream>
#include <string_view>

#include <CLI/CLI.hpp>

#include "base/error_list.h"
#include "base/interrupt.h"
#include "base/printable_stream.h"
#include "base/printable_text.h"
#include "robosim/command_line.h"
#include "robosim/subcommands.h"

namespace robosim {
namespace {

int fail(const std::string& command, int code, const std::string& what) {
  std::cout.flush();
  std::cerr << command << ": " << what << '\n';
  return code;
}

/// Marks the second and later lines of an error, so that a text from a peer cannot imitate a message of this program.
std::string indented(const std::string& what) {
  std::string text;
  for (const char c : what) text += c == '\n' ? std::string("\n  ") : std::string(1, c);
  return text;
}

constexpr const char* kFullDisk = "standard output could not be written; check whether the disk is full";

/// What CLI11 rejects, in the words of this program.
std::string textOf(const CLI::App& program, const CLI::ParseError& error) {
  const auto extra = program.remaining(true);
  if (error.get_exit_code() != static_cast<int>(CLI::ExitCodes::ExtrasError) || extra.empty()) return error.what();
  return "unexpected argument '" + quotable(extra.front()) + "'";
}

}  // namespace

void replaceHelpSubcommand(int argc, char** argv) {
  static char help[] = "--help";
  if (argc < 2 || argv[1] != std::string_view("help")) return;
  std::rotate(argv + 1, argv + 2, argv + argc);
  argv[argc - 1] = help;
}

int execute(CLI::App& program, int argc, char** argv, const std::function<void(CLI::App&)>& add_all) {
  removePartialFilesOnSignals();
  const PrintableStream out(std::cout), err(std::cerr);
  replaceHelpSubcommand(argc, argv);
  const auto [command, unknown] = findArgumentError(program, argc, argv, add_all);
  if (!unknown.empty()) return fail(command, kBadInput, unknown);
  const auto end = [&, &command = command](int code) {  // clang 14 captures a structured binding by an initialiser only
    std::cout.flush();
    return std::cout ? code : fail(command, kRunFailed, kFullDisk);
  };
  program.parse_complete_callback([&program] { checkPartners(program); });
  try {
    program.parse(argc, argv);
    return end(kDone);
  } catch (const CLI::ParseError& error) {
    // Help and version are not errors; everything else that CLI11 rejects is bad input, regardless of its own exit
    // code.
    if (error.get_exit_code() == 0) {
      program.exit(error);
      return end(kDone);
    }
    return fail(command, kBadInput, textOf(program, error) + "; see " + command + " --help");
  } catch (const Exit& exit) {
    return exit.code;
  } catch (const Interrupted& error) {
    const int signal = Interrupt::signal();
    return fail(command, 128 + (signal != 0 ? signal : SIGINT), error.what());
  } catch (const ConfigError& error) {
    return fail(command, kBadInput, error.what());
  } catch (const std::invalid_argument& error) {
    return fail(command, kBadInput, indented(error.what()));
  } catch (const std::exception& error) {
    return fail(command, kRunFailed, indented(error.what()));
  }
}

int executeRobosim(std::initializer_list<void (*)(CLI::App&)> add, int argc, char** argv,
                   const std::function<void(CLI::App&)>& add_all) {
  CLI::App program(
      "RoboSim simulates teams of cooperating mobile robots with sensors, and records runs as MRPT rawlogs.");
  program.name("robosim");
  setHelpFormat(program);
  program.set_version_flag("--version", "robosim " ROBOSIM_VERSION);
  program.require_subcommand(1);
  for (const auto add_subcommand : add) add_subcommand(program);
  // Set last, because subcommands would inherit it.
  program.footer(
      "Try:  robosim run opho2_1 --picture run.png\n"
      "      robosim help run                    (the same as robosim run --help)\n"
      "Exit codes: 0 success, 1 bad input, 2 run failed, 128 + N ended by signal N (130 Ctrl-C). serve and\n"
      "      remote run until a signal, which is then their regular end; of serve: 3 run incomplete\n"
      "      (without some of its robots), 4 a geometry worker returned wrong results.\n"
      "Log records on standard error: ROBOSIM_LOG_LEVEL=debug|info|warning|error omits those below a level\n"
      "      (default info).");
  return execute(program, argc, argv, add_all);
}

}  // namespace robosim
