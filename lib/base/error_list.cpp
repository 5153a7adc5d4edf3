#include "base/error_list.h"

#include <algorithm>

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
  add(file + ":" + std::to_string(line) + ": " + what);
}

void ErrorList::add(const ConfigError& error) {
  for (const auto& line : error.errors()) add(line);
}

void ErrorList::add(const std::string& error) {
  if (errors_.size() < kMostErrors) {
    errors_.push_back(error);
    return;
  }
  if (++more_ == 1) errors_.emplace_back();
  errors_.back() = "and " + std::to_string(more_) + (more_ == 1 ? " more error" : " more errors");
}

void ErrorList::throwIfAny() const {
  if (!errors_.empty()) throw ConfigError(errors_);
}

std::string listed(const std::vector<std::string>& words) {
  constexpr std::size_t most = 10;
  std::string all;
  for (std::size_t i = 0; i < std::min(most, words.size()); ++i) all += (i ? ", " : "") + words[i];
  return words.size() <= most ? all : all + " and " + std::to_string(words.size() - most) + " more";
}

}  // namespace robosim
