#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace robosim {

/// 1234567 → "1,234,567".
std::string withCommas(std::uint64_t number);
/// A number with so many digits behind the point.
std::string fixed(double number, int digits);

using Rows = std::vector<std::vector<std::string>>;
/// A table of figures as text: columns as wide as they need, the first flush left, the others flush right.
std::string table(const Rows& rows);
/// The same with every column flush left, for words.
std::string listing(const Rows& rows);

}  // namespace robosim
