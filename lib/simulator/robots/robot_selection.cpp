#include "robots/robot_selection.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <optional>
#include <string_view>

#include "base/error_list.h"
#include "base/nearest_name.h"

namespace robosim {
namespace {

constexpr std::string_view kTo = "..";

bool isDigit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

/// A name that ends in a number.
struct Numbered {
  std::string_view letters;
  std::uint64_t number = 0;
};

std::optional<Numbered> numbered(std::string_view name) {
  std::size_t begin = name.size();
  while (begin > 0 && isDigit(name[begin - 1])) --begin;
  Numbered result{name.substr(0, begin)};
  const char* const end = name.data() + name.size();
  const auto [read, error] = std::from_chars(name.data() + begin, end, result.number);
  if (begin == name.size() || error != std::errc() || read != end) return std::nullopt;
  return result;
}

struct Range {
  Numbered first, last;
};

/// nullopt for a pattern that is no range. @throws ConfigError for a range that ends before it begins
std::optional<Range> rangeIn(std::string_view pattern) {
  const auto dots = pattern.find(kTo);
  if (dots == std::string_view::npos) return std::nullopt;
  const auto first = numbered(pattern.substr(0, dots)), last = numbered(pattern.substr(dots + kTo.size()));
  if (!first || !last || (!last->letters.empty() && last->letters != first->letters)) return std::nullopt;
  if (first->number > last->number) {
    throw ConfigError("--only " + std::string(pattern) +
                      ": the range ends before it begins; give the lower number first");
  }
  return Range{*first, *last};
}

/// Whether a name matches a pattern with * and ?; greedy, returning to the last * after a mismatch.
bool matchesWildcards(std::string_view name, std::string_view pattern) {
  std::size_t n = 0, p = 0, after_star = std::string_view::npos, star_n = 0;
  while (n < name.size()) {
    if (p < pattern.size() && pattern[p] == '*') {
      after_star = ++p;
      star_n = n;
    } else if (p < pattern.size() && (pattern[p] == '?' || pattern[p] == name[n])) {
      ++p;
      ++n;
    } else if (after_star != std::string_view::npos) {
      p = after_star;
      n = ++star_n;
    } else {
      return false;
    }
  }
  return pattern.find_first_not_of('*', p) == std::string_view::npos;
}

}  // namespace

std::vector<std::uint8_t> RobotSelection::flagsIn(const Fleet& fleet, Unmatched unmatched) const {
  std::vector<std::uint8_t> flags;
  if (isAll()) return flags;
  flags.resize(fleet.robots.size());
  for (const std::string& pattern : patterns_) {
    const auto range = rangeIn(pattern);
    const auto matches = [&](const std::string& name) {
      if (!range) return matchesWildcards(name, pattern);
      const auto one = numbered(name);
      return one && one->letters == range->first.letters && one->number >= range->first.number &&
             one->number <= range->last.number;
    };
    const auto named = std::find_if(fleet.robots.begin(), fleet.robots.end(),
                                    [&](const FleetRobot& robot) { return robot.info.name == pattern; });
    bool has_matched = named != fleet.robots.end();
    if (has_matched) flags[static_cast<std::size_t>(named - fleet.robots.begin())] = 1;
    for (std::size_t i = 0; i < flags.size() && named == fleet.robots.end(); ++i) {
      if (!matches(fleet.robots[i].info.name)) continue;
      flags[i] = 1;
      has_matched = true;
    }
    if (!has_matched && unmatched == Unmatched::refused) {
      throw ConfigError("--only " + pattern + ": " + describeUnknownRobot(pattern, fleet));
    }
  }
  return flags;
}

std::string describeUnknownRobot(const std::string& name, const Fleet& fleet) {
  constexpr std::size_t kMaxLetters = 200;
  std::vector<std::string> names;
  for (const auto& robot : fleet.robots) names.push_back(robot.info.name);
  const std::string text = "there is no robot " + name;
  if (const std::string nearest = didYouMean(name, names); !nearest.empty()) return text + nearest;
  if (names.empty()) return text + "; there is none";
  std::string list;
  std::size_t listed = 0;
  for (; listed < names.size() && list.size() <= kMaxLetters; ++listed)
    list += (listed == 0 ? "" : ", ") + names[listed];
  const std::size_t left = names.size() - listed;
  return text + "; there " + (names.size() == 1 ? "is " : "are ") + list +
         (left == 0 ? "" : " and " + std::to_string(left) + " more");
}

}  // namespace robosim
