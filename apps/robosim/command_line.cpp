#include "robosim/command_line.h"

#include <algorithm>
#include <map>
#include <sstream>
#include <utility>

#include <CLI/CLI.hpp>

#include "base/error_list.h"
#include "base/nearest_name.h"
#include "base/printable_text.h"
#include "base/text_table.h"
#include "base/xml_element.h"

namespace robosim {
namespace {

struct Partner {
  std::string text;
  std::function<bool()> holds;
};

/// Of the options of the last program that setHelpFormat() was called for. A process has one, except in tests.
std::map<const CLI::Option*, Partner>& partners() {
  static std::map<const CLI::Option*, Partner> all;
  return all;
}

std::string nameOf(const CLI::Option& option) { return option.get_name(false, false); }

/// The parts of Option::get_type_name(): CLI11 joins the name of the type and the descriptions of validators by colons.
struct ValueText {
  std::string type;   ///< SECONDS, or on|off
  std::string range;  ///< "0.001 to 1"; empty: none
};

ValueText valueOf(const CLI::Option& option) {
  ValueText value{option.get_type_name(), ""};
  if (option.get_items_expected_max() == 0) return {};  // a flag
  if (const auto at = value.type.find(std::string(":") + kRangeMark); at != std::string::npos) {
    value.range = value.type.substr(at + 2);
    value.type.resize(at);
  }
  if (const auto at = value.type.find(":{"); at != std::string::npos) {
    std::string choices = value.type.substr(at + 2);
    choices.resize(std::min(choices.find('}'), choices.size()));
    std::replace(choices.begin(), choices.end(), ',', '|');
    value.type = choices;
  }
  return value;
}

std::string leftColumn(const CLI::Option& option) {
  if (option.get_positional() && !option.nonpositional()) return "  " + option.get_name(true, false);
  const std::string names = option.get_name(false, true);
  const std::string type = valueOf(option).type;
  return "  " + names.substr(names.find_first_of('-')) + (type.empty() ? "" : " " + type);
}

/// The help, with "(0.001 to 1; default 0.1; requires --print)".
std::string rightColumn(const CLI::Option& option) {
  std::string notes;
  const auto add = [&](const std::string& note) { notes += (notes.empty() ? "" : "; ") + note; };
  if (const auto range = valueOf(option).range; !range.empty()) add(range);
  if (const auto& fallback = option.get_default_str(); !fallback.empty()) add("default " + fallback);
  if (const auto partner = partners().find(&option); partner != partners().end()) {
    add("requires " + partner->second.text);
  }
  const std::string& help = option.get_description();
  if (notes.empty()) return help;
  return (help.empty() ? "" : help + " ") + "(" + notes + ")";
}

constexpr std::size_t kHelpIndent = 30;

void appendRow(std::string& text, const std::string& left, const std::string& right) {
  if (right.empty()) {
    text += left + '\n';
    return;
  }
  const std::size_t column = displayWidth(left);
  const bool fits = column + 2 <= kHelpIndent;
  const std::string before = fits ? left + std::string(kHelpIndent - column, ' ') : std::string(kHelpIndent, ' ');
  if (!fits) text += left + '\n';
  text += wrappedLine(before + right, kHelpColumns) + '\n';
}

std::string usage(const CLI::App& app, const std::string& name) {
  std::string text = "Usage: " + name + " [OPTIONS]";
  for (const CLI::Option* option : app.get_options()) {
    if (!option->get_positional() || option->get_group().empty()) continue;
    std::string word = option->get_name(true, false);
    if (option->get_items_expected_max() > 1) word += "...";
    text += option->get_required() ? " " + word : " [" + word + "]";
  }
  const auto subcommands = app.get_subcommands([](const CLI::App*) { return true; });
  if (!subcommands.empty()) text += app.get_require_subcommand_min() > 0 ? " SUBCOMMAND" : " [SUBCOMMAND]";
  return text + "\n";
}

/// The lines of a footer, with longer ones divided; those of a table, "  name  help", below the help.
std::string makeFooter(const CLI::App& app) {
  std::istringstream lines(app.get_footer());
  std::string text;
  for (std::string line; std::getline(lines, line);) text += wrappedLine(line, kHelpColumns) + "\n";
  return text;
}

std::string makeHelp(const CLI::App& app, std::string name) {
  name = CLI::detail::trim_copy(name);  // those of all commands from the program on
  std::string text;
  if (!app.get_description().empty()) text += wrappedLine(app.get_description(), kHelpColumns) + "\n";
  text += usage(app, name);
  std::string arguments;
  std::vector<std::pair<std::string, std::string>> groups;  // in their order, the general one last
  const auto group = [&](const std::string& title) -> std::string& {
    const auto found = std::find_if(groups.begin(), groups.end(), [&](const auto& one) { return one.first == title; });
    if (found != groups.end()) return found->second;
    groups.emplace_back(title, "");
    return groups.back().second;
  };
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_group().empty()) continue;  // hidden
    if (option->get_positional() && !option->nonpositional()) {
      appendRow(arguments, leftColumn(*option), rightColumn(*option));
    } else {
      appendRow(group(option->get_group()), leftColumn(*option), rightColumn(*option));
    }
  }
  if (!arguments.empty()) text += "\nPositionals:\n" + arguments;
  std::stable_sort(groups.begin(), groups.end(),
                   [](const auto& a, const auto& b) { return (a.first == "Options") < (b.first == "Options"); });
  for (const auto& [title, rows] : groups) {
    text += "\n" + (title == "Options" && groups.size() > 1 ? std::string("General options") : title) + ":\n" + rows;
  }
  const auto subcommands = app.get_subcommands([](const CLI::App*) { return true; });
  if (!subcommands.empty()) text += "\nSubcommands:\n";
  for (const CLI::App* subcommand : subcommands) {
    appendRow(text, "  " + subcommand->get_name(), subcommand->get_description());
  }
  if (const std::string footer = makeFooter(app); !footer.empty()) text += "\n" + footer;
  return text;
}

/// The option that an argument such as --time=5 or -p8101 is, of a command or of those above it whose options may
/// follow it; null: none.
const CLI::Option* findOption(const CLI::App& command, const std::string& argument) {
  const bool is_long = argument.starts_with("--");
  const std::string name = is_long ? argument.substr(0, argument.find('=')) : argument.substr(0, 2);
  for (const CLI::App* app = &command; app != nullptr; app = app->get_fallthrough() ? app->get_parent() : nullptr) {
    for (const CLI::Option* option : app->get_options()) {
      if (option->check_name(name)) return option;
    }
  }
  return nullptr;
}

std::vector<std::string> optionNames(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::App* app = &command; app != nullptr; app = app->get_fallthrough() ? app->get_parent() : nullptr) {
    for (const CLI::Option* option : app->get_options()) {
      if (option->get_group().empty()) continue;
      for (const auto& name : option->get_lnames()) names.push_back("--" + name);
    }
  }
  return names;
}

/// Paths of the commands below one that have an option.
void findOwners(const CLI::App& command, const std::string& path, const std::string& option,
                std::vector<std::string>& owners) {
  for (const CLI::App* subcommand : command.get_subcommands([](const CLI::App*) { return true; })) {
    const std::string name = path + " " + subcommand->get_name();
    const auto known = optionNames(*subcommand);
    const bool is_new = std::find(owners.begin(), owners.end(), name) == owners.end();
    if (is_new && std::find(known.begin(), known.end(), option) != known.end()) owners.push_back(name);
    findOwners(*subcommand, name, option, owners);
  }
}

bool isOption(const std::string& argument) {
  return argument.size() > 1 && argument[0] == '-' && argument != "--" && !parseNumber(argument);
}

const CLI::App* findSubcommand(const CLI::App& command, const std::string& name) {
  for (const CLI::App* one : command.get_subcommands([](const CLI::App*) { return true; })) {
    if (one->check_name(name)) return one;
  }
  return nullptr;
}

std::string unknownOption(const CLI::App& program, const CLI::App& command, const std::string& path,
                          const std::string& name, const std::vector<std::string>& later,
                          const std::function<void(CLI::App&)>& add_all) {
  const std::string text = quotable(name) + ": unknown option";
  const std::string help = "; see " + path + " --help";
  std::vector<std::string> owners;
  findOwners(program, program.get_name(), name, owners);
  if (owners.empty() && add_all && name.starts_with("--")) {
    CLI::App all;
    try {
      add_all(all);
    } catch (const std::exception&) {
      // An installation without these subcommands.
    }
    findOwners(all, program.get_name(), name, owners);
  }
  if (const std::string nearest = didYouMean(name, optionNames(command)); !nearest.empty()) return text + nearest;
  if (!owners.empty()) return text + "; it is one of " + listed(owners) + help;
  for (const auto& word : later) {
    if (!findSubcommand(command, word)) continue;
    return text + "; options of a subcommand follow its name, as in " + path + " " + word + " " + quotable(name);
  }
  return text + help;
}

std::string unknownSubcommand(const CLI::App& command, const std::string& path, const std::string& word) {
  std::vector<std::string> known;
  for (const CLI::App* one : command.get_subcommands([](const CLI::App*) { return true; })) {
    known.push_back(one->get_name());
  }
  std::string all;
  for (const auto& name : known) all += (all.empty() ? "" : ", ") + name;
  const std::string text =
      word.empty() ? "a subcommand is required" : "there is no subcommand '" + quotable(word) + "'";
  return text + (word.empty() ? "" : didYouMean(word, known)) + "; known are: " + all + "; see " + path + " --help";
}

}  // namespace

void setHelpFormat(CLI::App& program) {
  partners().clear();  // of an earlier program, whose options may have had the addresses of those that follow
  program.formatter_fn([](const CLI::App* app, std::string name, CLI::AppFormatMode) { return makeHelp(*app, name); });
}

CLI::Option* dependsOn(CLI::Option* option, const CLI::Option* partner) {
  return dependsOn(option, std::vector{partner});
}

CLI::Option* dependsOn(CLI::Option* option, const std::vector<const CLI::Option*>& any_of) {
  std::string text;
  for (const CLI::Option* one : any_of) text += (text.empty() ? "" : " or ") + nameOf(*one);
  return dependsOn(option, text, [any_of] {
    return std::any_of(any_of.begin(), any_of.end(), [](const CLI::Option* one) { return one->count() > 0; });
  });
}

CLI::Option* dependsOn(CLI::Option* option, const std::string& partner, const std::function<bool()>& holds) {
  partners().insert_or_assign(option, Partner{partner, holds});
  return option;
}

void checkPartners(const CLI::App& program) {
  for (const CLI::Option* option : program.get_options()) {
    const auto partner = partners().find(option);
    if (option->count() == 0 || partner == partners().end() || partner->second.holds()) continue;
    throw ConfigError(nameOf(*option) + ": has no effect without " + partner->second.text + "; add that, or omit " +
                      nameOf(*option));
  }
  for (const CLI::App* subcommand : program.get_subcommands()) checkPartners(*subcommand);
}

ArgumentError findArgumentError(const CLI::App& program, int argc, char** argv,
                                const std::function<void(CLI::App&)>& add_all) {
  const CLI::App* command = &program;
  ArgumentError error{program.get_name(), ""};
  const std::vector<std::string> arguments(argv + std::min(argc, 1), argv + argc);
  std::vector<std::string> words;  // of the present command
  bool asks_for_help = false;
  for (std::size_t i = 0; i < arguments.size() && arguments[i] != "--"; ++i) {
    const std::string& argument = arguments[i];
    if (!isOption(argument)) {
      const CLI::App* subcommand = findSubcommand(*command, argument);
      if (subcommand) {
        command = subcommand;
        error.command += " " + command->get_name();
        words.clear();
      } else {
        words.push_back(argument);
      }
      continue;
    }
    const CLI::Option* option = findOption(*command, argument);
    if (!option) {
      const std::string name = argument.substr(0, argument.find('='));
      const std::vector<std::string> later(arguments.begin() + static_cast<std::ptrdiff_t>(i) + 1, arguments.end());
      error.text = unknownOption(program, *command, error.command, name, later, add_all);
      return error;
    }
    asks_for_help = asks_for_help || option == command->get_help_ptr() || option == command->get_version_ptr();
    const bool has_value = argument.find('=') != std::string::npos || (argument[1] != '-' && argument.size() > 2);
    if (!has_value) i += static_cast<std::size_t>(std::max(0, option->get_items_expected_min()));
  }
  const bool needs_subcommand = command->get_require_subcommand_min() > 0;
  if (needs_subcommand && !asks_for_help) {
    error.text = unknownSubcommand(*command, error.command, words.empty() ? "" : words.back());
  }
  return error;
}

void setGroup(CLI::App& command, const std::string& group, std::initializer_list<const char*> options) {
  for (const char* name : options) command.get_option(name)->group(group);
}

}  // namespace robosim
