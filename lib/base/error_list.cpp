#include "base/error_list.h"

namespace robosim {
namespace {

std::string joined(const std::vector<std::string>& lines) {
  std::string all;
  for (const auto& line : lines) all += (all.empty() ? "" : "\n") + line;
  return all;
}

}  // namespace

ConfigError::ConfigError(std::vector<std::string> errors)
    : std::runtime_error(joined(errors)), errors_(std::move(errors)) {}

void ErrorList::add(const std::string& file, int line, const std::string& what) {
  errors_.push_back(file + ":" + std::to_string(line) + ": " + what);
}

void ErrorList::add(const ConfigError& error) {
  errors_.insert(errors_.end(), error.errors().begin(), error.errors().end());
}

void ErrorList::throwIfAny() const {
  if (!errors_.empty()) throw ConfigError(errors_);
}

}  // namespace robosim
