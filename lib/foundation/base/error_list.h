#pragma once
#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

namespace robosim {

/// Errors in input files or arguments: what is wrong, where, and how to fix it. `what()` has one error per line. Each
/// error is stored as printableText() of at most about 2,000 bytes, whatever the input is.
class ConfigError : public std::runtime_error {
 public:
  explicit ConfigError(std::vector<std::string> errors);
  explicit ConfigError(const std::string& error) : ConfigError(std::vector<std::string>{error}) {}
  const std::vector<std::string>& errors() const { return errors_; }

 private:
  std::vector<std::string> errors_;
};

/// Collects the errors of one load, to report all of them at once: the first kMaxErrors, and the number of further
/// ones, so that memory is bounded.
class ErrorList {
 public:
  void add(const std::string& file, int line, const std::string& what);
  void add(const ConfigError& error);
  static constexpr std::size_t kMaxErrors = 1000;

  bool empty() const { return errors_.empty(); }
  /// Number of all errors, including those beyond kMaxErrors.
  std::size_t count() const { return std::min(errors_.size(), kMaxErrors) + more_; }
  const std::vector<std::string>& errors() const { return errors_; }
  /// @throws ConfigError with all errors, if there are any.
  void throwIfAny() const;

 private:
  void add(const std::string& error);

  std::vector<std::string> errors_;
  std::size_t more_ = 0;
};

/// "a, b, c" for an error message; of a long list the first twenty, and the number of further ones.
std::string listed(const std::vector<std::string>& words);

}  // namespace robosim
