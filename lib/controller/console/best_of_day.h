#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace robosim {

/// A win, as displayed to visitors.
struct DayResult {
  std::string name;
  std::string team{};  ///< empty for none
  double time_s = 0;
  std::optional<double> distance_m{};
};

/// Wins of a team of visitors.
struct TeamStanding {
  std::string team;
  std::size_t wins = 0;
  double best_s = 0;
};

/// The fastest wins of a day, in ascending order of their times; of equal times, the earlier win is first. At most
/// kMaxResults.
class BestOfDay {
 public:
  static constexpr std::size_t kMaxResults = 1000;

  BestOfDay() = default;

  /// Begins a new list if the day differs. @param day such as "2026-11-28"
  void setDay(const std::string& day);
  /// @return rank of the result, from 1
  std::size_t add(const DayResult& result);
  const std::vector<DayResult>& results() const { return results_; }
  /// Teams by the number of their wins, then by their best time.
  std::vector<TeamStanding> standings() const;

  /// The list as a file (JSON).
  std::string text() const;
  /// @param file its name, for errors
  /// @throws ConfigError for a text that text() does not return.
  static BestOfDay parse(std::string_view text, const std::string& file);

 private:
  std::string day_;
  std::vector<DayResult> results_;
};

}  // namespace robosim
