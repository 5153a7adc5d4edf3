#include "replay/csv_field.h"

#include <charconv>

#include "base/printable_text.h"

namespace robosim {
namespace {

struct ExactText {
  std::string operator()(std::monostate) const { return ""; }
  std::string operator()(const std::string& text) const { return csvField(text); }
  std::string operator()(auto number) const {
    char text[64];
    return {text, std::to_chars(text, text + sizeof text, number).ptr};
  }
};

}  // namespace

std::string csvField(const std::string& text) {
  const std::string safe = printableText(text);
  if (safe.find_first_of(",\"") == std::string::npos) return safe;
  std::string quoted = "\"";
  for (const char c : safe) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

std::string csvField(const ColumnValue& value) { return std::visit(ExactText(), value); }

}  // namespace robosim
