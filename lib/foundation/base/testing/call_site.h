#pragma once
#include <string>

namespace robosim {

/// Place of a call: the default of a parameter `const CallSite& place = CallSite::here()`. Like std::source_location,
/// which clang 14 lacks.
struct CallSite {
  const char* file;
  int line;

  static constexpr CallSite here(const char* file = __builtin_FILE(), int line = __builtin_LINE()) {
    return {file, line};
  }
  std::string text() const { return std::string(file) + ':' + std::to_string(line); }
};

}  // namespace robosim
