#include "base/error_list.h"

#include <algorithm>

#include "base/printable_text.h"

namespace robosim {
namespace {

/// Maximum length of a stored error [bytes].
constexpr std::size_t kMaxErrorBytes = 2000;

std::string errorLine(const std::string& error) { return printableText(shortened(error, kMaxErrorBytes)); }

std::vector<std::string> errorLines(std::vector<std::string> errors) {
  for (auto& error : errors) error = errorLine(error);
  return errors;
}

std::string joined(const std::vector<std::string>& lines) {
  std::string all;
  for (const auto& line : lines) all += (all.empty() ? "" : "\n") + line;
  return all;
}

}  // namespace

ConfigError::ConfigError(std::vector<std::string> errors)
    : std::runtime_error(joined(errorLines(errors))), errors_(errorLines(std::move(errors))) {}

void ErrorList::add(const std::string& file, int line, const std::string& what) {
  // Line 0: the file has no lines.
  add(file + (line > 0 ? ":" + std::to_string(line) : "") + ": " + what);
}

void ErrorList::add(const ConfigError& error) {
  for (const auto& line : error.errors()) add(line);
}

void ErrorList::add(const std::string& error) {
  if (errors_.size() < kMaxErrors) {
    errors_.push_back(errorLine(error));
    return;
  }
  if (++more_ == 1) errors_.emplace_back();
  errors_.back() = "and " + std::to_string(more_) + (more_ == 1 ? " more error" : " more errors");
}

void ErrorList::throwIfAny() const {
  if (!errors_.empty()) throw ConfigError(errors_);
}

std::string listed(const std::vector<std::string>& words) {
  constexpr std::size_t max_listed = 20;
  std::string all;
  for (std::size_t i = 0; i < std::min(max_listed, words.size()); ++i) all += (i ? ", " : "") + words[i];
  return words.size() <= max_listed ? all : all + " and " + std::to_string(words.size() - max_listed) + " more";
}

}  // namespace robosim
