#include "maze/message_numbers.h"

#include <charconv>

namespace robosim {

std::string messageText(const std::string& word, std::initializer_list<std::int64_t> numbers) {
  std::string text = word;
  for (const auto number : numbers) text += " " + std::to_string(number);
  return text;
}

std::optional<std::vector<std::int64_t>> numbersOf(const std::string& text, const std::string& word,
                                                   std::size_t count) {
  constexpr std::int64_t kMax = 1'000'000'000;
  if (!text.starts_with(word)) return std::nullopt;
  std::vector<std::int64_t> numbers;
  const char* at = text.data() + word.size();
  const char* const end = text.data() + text.size();
  while (at != end) {
    if (*at != ' ' || numbers.size() == count) return std::nullopt;
    std::int64_t number = 0;
    const auto [stop, error] = std::from_chars(at + 1, end, number);
    if (error != std::errc{} || number < -kMax || number > kMax) return std::nullopt;
    numbers.push_back(number);
    at = stop;
  }
  if (numbers.size() != count) return std::nullopt;
  return numbers;
}

}  // namespace robosim
