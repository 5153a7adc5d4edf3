#pragma once
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

namespace robosim {

/// Text of a message between robots: a word and whole numbers, "TARGET 1200 -350".
std::string messageText(const std::string& word, std::initializer_list<std::int64_t> numbers);

/// The numbers of such a text, each in [-1e9, 1e9]; nullopt for another word or count, or anything else.
std::optional<std::vector<std::int64_t>> numbersOf(const std::string& text, const std::string& word, std::size_t count);

}  // namespace robosim
