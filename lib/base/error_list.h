#pragma once
#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

namespace robosim {

/// A fault in a file or an argument that a person gave: what is wrong, where, and how to mend it.
/// `what()` has one error a line.
class ConfigError : public std::runtime_error {
 public:
  explicit ConfigError(std::vector<std::string> errors);
  explicit ConfigError(const std::string& error) : ConfigError(std::vector<std::string>{error}) {}
  const std::vector<std::string>& errors() const { return errors_; }

 private:
  std::vector<std::string> errors_;
};

/// Gathers the errors of one load, so that a person sees all of them at once: each of the first kMostErrors, and how
/// many more there were, so that a hopeless file cannot fill the memory.
class ErrorList {
 public:
  void add(const std::string& file, int line, const std::string& what);
  void add(const ConfigError& error);
  static constexpr std::size_t kMostErrors = 1000;

  bool empty() const { return errors_.empty(); }
  /// How many there are, told one by one or not.
  std::size_t count() const { return std::min(errors_.size(), kMostErrors) + more_; }
  const std::vector<std::string>& errors() const { return errors_; }
  /// @throws ConfigError with all errors, if there are any.
  void throwIfAny() const;

 private:
  void add(const std::string& error);

  std::vector<std::string> errors_;
  std::size_t more_ = 0;
};

/// "a, b, c" for an error message; of a long list the first ten, and how many more there are.
std::string listed(const std::vector<std::string>& words);

}  // namespace robosim
