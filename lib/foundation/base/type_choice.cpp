#include "base/type_choice.h"

#include <algorithm>

#include "base/error_list.h"

namespace robosim {

TypeChoice TypeChoice::parse(const std::string& text, const std::string& kind) {
  constexpr const char* kBlanks = " \t\r\n";
  std::size_t end = 0;
  const auto next = [&] {
    const std::size_t begin = std::min(text.find_first_not_of(kBlanks, end), text.size());
    end = std::min(text.find_first_of(kBlanks, begin), text.size());
    return text.substr(begin, end - begin);
  };
  TypeChoice choice{next(), {}};
  if (choice.name.empty())
    throw ConfigError((kind == "observer" ? "the name of an " : "the name of a ") + kind + " is missing");
  for (std::string word = next(); !word.empty(); word = next()) {
    const auto equals = word.find('=');
    if (equals == 0 || equals == std::string::npos || equals + 1 == word.size()) {
      throw ConfigError(kind + " '" + choice.name + "': '" + word + "' is no parameter; write PARAMETER=VALUE");
    }
    choice.parameters.emplace_back(word.substr(0, equals), word.substr(equals + 1));
  }
  return choice;
}

std::string TypeChoice::text() const {
  std::string text = name;
  for (const auto& [parameter, value] : parameters) text += " " + parameter + "=" + value;
  return text;
}

}  // namespace robosim
