#include "robosim/program.h"

#include <algorithm>
#include <csignal>
#include <iostream>
#include <optional>

#include <CLI/CLI.hpp>

#include "base/error_list.h"
#include "base/interrupt.h"
#include "base/printable_stream.h"
#include "base/printable_text.h"
#include "robosim/subcommands.h"

namespace robosim {
namespace {

int fail(const CLI::App& program, int code, const std::string& what) {
  std::cout.flush();
  std::cerr << program.get_name() << ": " << what << '\n';
  return code;
}

/// Marks the second and later lines of an error, so that a text from a peer cannot imitate a message of this program.
std::string indented(const std::string& what) {
  std::string text;
  for (const char c : what) text += c == '\n' ? std::string("\n  ") : std::string(1, c);
  return text;
}

/// The first word in the position of a subcommand that is no subcommand; CLI11 would report a missing subcommand
/// instead.
std::optional<std::string> unknownSubcommand(const CLI::App& program, int argc, char** argv) {
  const CLI::App* command = &program;
  std::string path = program.get_name();
  for (int i = 1; i < argc && argv[i][0] != '-'; ++i) {
    const auto all = command->get_subcommands([](const CLI::App*) { return true; });
    const auto options = command->get_options();
    const bool has_positional =
        std::any_of(options.begin(), options.end(), [](const CLI::Option* option) { return option->get_positional(); });
    if (all.empty() || has_positional) return std::nullopt;
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const CLI::App* one) { return one->check_name(argv[i]); });
    if (found == all.end()) {
      std::string known;
      for (const CLI::App* one : all) known += (known.empty() ? "" : ", ") + one->get_name();
      return "there is no subcommand '" + quotable(argv[i]) + "' of " + path + "; known are: " + known + "; see " +
             path + " --help";
    }
    command = *found;
    path += " " + command->get_name();
  }
  return std::nullopt;
}

}  // namespace

int execute(CLI::App& program, int argc, char** argv) {
  removePartialFilesOnSignals();
  const PrintableStream out(std::cout), err(std::cerr);
  if (const auto error = unknownSubcommand(program, argc, argv)) return fail(program, kBadInput, *error);
  try {
    program.parse(argc, argv);
    std::cout.flush();
    if (!std::cout)
      return fail(program, kRunFailed, "standard output could not be written; check whether the disk is full");
    return kDone;
  } catch (const CLI::ParseError& error) {
    // Help and version are not errors; everything else that CLI11 rejects is bad input, regardless of its own exit
    // code.
    return program.exit(error) == 0 ? kDone : kBadInput;
  } catch (const Exit& exit) {
    return exit.code;
  } catch (const Interrupted& error) {
    const int signal = Interrupt::signal();
    return fail(program, 128 + (signal != 0 ? signal : SIGINT), error.what());
  } catch (const ConfigError& error) {
    return fail(program, kBadInput, error.what());
  } catch (const std::invalid_argument& error) {
    return fail(program, kBadInput, indented(error.what()));
  } catch (const std::exception& error) {
    return fail(program, kRunFailed, indented(error.what()));
  }
}

int executeRobosim(std::initializer_list<void (*)(CLI::App&)> add, int argc, char** argv) {
  CLI::App program(
      "RoboSim simulates teams of cooperating mobile robots with sensors, and records runs as MRPT rawlogs.");
  program.name("robosim");
  program.set_version_flag("--version", "robosim " ROBOSIM_VERSION);
  program.require_subcommand(1);
  program.footer(
      "Try:  robosim run worlds/opho2_1.xml --picture run.png\n"
      "Exit codes: 0 success, 1 bad input, 2 run failed, 128 + N ended by signal N (130 Ctrl-C). serve and remote\n"
      "      run until a signal, which is then their regular end; of serve: 3 run incomplete (without some of its "
      "robots),\n"
      "      4 a geometry worker returned wrong results.\n"
      "Log records on standard error: ROBOSIM_LOG_LEVEL=debug|info|warning|error omits those below a level (default "
      "info).");
  for (const auto add_subcommand : add) add_subcommand(program);
  return execute(program, argc, argv);
}

}  // namespace robosim
