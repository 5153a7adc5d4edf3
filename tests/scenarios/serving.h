#pragma once
#include <algorithm>
#include <string>
#include <vector>

#include "tests/scenarios/program.h"

namespace robosim {

/// `robosim serve`, listening on a port chosen by the system. Without a --step-deadline it waits for clients as long as
/// a slow machine may delay them.
class Serving {
 public:
  explicit Serving(std::vector<std::string> arguments, const std::string& world = "worlds/small_maze.xml")
      : program_(words(std::move(arguments), world)) {
    const std::string says = "listening on ";
    program_.waitForError(says);
    const std::string text = program_.error();
    const auto at = text.find(says) + says.size();
    address_ = text.substr(at, text.find('\n', at) - at);
  }

  const std::string& address() const { return address_; }
  StartedProgram& program() { return program_; }

 private:
  static std::vector<std::string> words(std::vector<std::string> arguments, const std::string& world) {
    arguments.insert(arguments.begin(), {"serve", world, "--listen", ":0"});
    const std::string deadline = "--step-deadline";
    if (std::find(arguments.begin(), arguments.end(), deadline) == arguments.end()) {
      arguments.insert(arguments.end(), {deadline, "600"});
    }
    return arguments;
  }

  StartedProgram program_;
  std::string address_;
};

}  // namespace robosim
