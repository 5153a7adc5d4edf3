#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace robosim {

/// 1234567 → "1,234,567".
std::string withCommas(std::uint64_t number);
/// A number with a fixed number of decimal places.
std::string fixed(double number, int digits);

/// Number of columns that a text takes on a terminal: its characters rather than bytes.
std::size_t displayWidth(const std::string& text);
/// Divides a line of more than `columns` between words. The further lines begin below the last column of a table, whose
/// columns are two or more spaces apart, or as far to the right as the line itself.
std::string wrappedLine(const std::string& line, std::size_t columns);

using Rows = std::vector<std::vector<std::string>>;
/// A text table of numbers: columns as wide as necessary, the first left-aligned, the others right-aligned. Every cell
/// is printed as printableText().
std::string table(const Rows& rows);
/// The same with all columns left-aligned, for words.
std::string listing(const Rows& rows);

}  // namespace robosim
