#include "robosim/arguments.h"

#include <charconv>
#include <cmath>
#include <cstdlib>

#include <CLI/CLI.hpp>

#include "base/error_list.h"
#include "base/xml_element.h"

namespace robosim {

CLI::Validator numberIn(double low, double high) {
  const std::string range = "[" + toText(low) + ", " + toText(high) + "]";
  return {[=](std::string& text) -> std::string {
            double number = 0;
            const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), number);
            const bool fits = error == std::errc{} && stop == text.data() + text.size() && std::isfinite(number) &&
                              number >= low && number <= high;
            return fits ? "" : text + ": must be a number in " + range;
          },
          ""};
}

CLI::Validator seedNumber() {
  return {[](std::string& text) -> std::string {
            std::uint64_t number = 0;
            const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), number);
            return error == std::errc{} && stop == text.data() + text.size()
                       ? ""
                       : text + ": must be a whole number from 0 to 18446744073709551615";
          },
          ""};
}

CLI::Validator fileName() {
  return {[](std::string& text) -> std::string { return text.empty() ? "the file's name is empty" : ""; }, ""};
}

double speedNumber(const std::string& speed) {
  if (speed == "max") return 0;
  char* end = nullptr;
  const double number = std::strtod(speed.c_str(), &end);
  if (speed.empty() || *end != '\0' || !(number >= 0.001 && number <= 1e6)) {
    throw ConfigError("--speed " + speed + ": must be 'max' or a number in [0.001, 1000000]; 1 is real time");
  }
  return number;
}

void addPatience(CLI::App& command, double& patience_s) {
  command.add_option("--patience", patience_s, "how long to call again when the connection breaks")
      ->check(numberIn(0, 1e6))
      ->type_name("SECONDS")
      ->capture_default_str();
}

void refuseSameFile(const std::vector<std::pair<std::string, std::filesystem::path>>& files) {
  for (std::size_t i = 0; i < files.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (files[i].second.empty() || files[j].second.empty()) continue;
      std::error_code none;
      const bool same = std::filesystem::weakly_canonical(files[i].second, none) ==
                            std::filesystem::weakly_canonical(files[j].second, none) ||
                        std::filesystem::equivalent(files[i].second, files[j].second, none);
      if (same) {
        throw ConfigError(files[i].second.string() + ": is both " + files[j].first + " and " + files[i].first +
                          "; name two files");
      }
    }
  }
}

}  // namespace robosim
