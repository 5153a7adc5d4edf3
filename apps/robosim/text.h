#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace robosim {

/// 1234567 → "1,234,567".
std::string withCommas(std::uint64_t number);
/// A number with so many digits behind the point.
std::string fixed(double number, int digits);

/// A stranger's text as it may go to a terminal: what would steer one (ESC and other control characters) as "\x1b".
std::string printable(const std::string& text);

using Rows = std::vector<std::vector<std::string>>;
/// A table of figures as text: columns as wide as they need, the first flush left, the others flush right.
std::string table(const Rows& rows);
/// The same with every column flush left, for words.
std::string listing(const Rows& rows);

}  // namespace robosim
