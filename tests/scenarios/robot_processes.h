#pragma once
#include <memory>
#include <string>
#include <vector>

#include "tests/scenarios/program.h"

namespace robosim {

/// `robosim robot NAME… --environment ADDRESS` with the controller `wander`.
inline std::unique_ptr<StartedProgram> startRobots(const std::vector<std::string>& names, const std::string& address,
                                                   const std::string& controller = "wander") {
  std::vector<std::string> words{"robot"};
  words.insert(words.end(), names.begin(), names.end());
  for (const auto& word : {std::string("--environment"), address, std::string("--controller"), controller}) {
    words.push_back(word);
  }
  return std::make_unique<StartedProgram>(words);
}

inline std::unique_ptr<StartedProgram> startWorker(const std::string& address) {
  return std::make_unique<StartedProgram>(std::vector<std::string>{"geometry", "--environment", address});
}

}  // namespace robosim
