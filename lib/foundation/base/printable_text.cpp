#include "base/printable_text.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>

#include "base/utf8.h"

namespace robosim {
namespace {

char32_t decode(std::string_view sequence) {
  const auto first = static_cast<std::uint8_t>(sequence[0]);
  if (sequence.size() == 1) return first;
  char32_t code_point = first & (0x7fu >> sequence.size());
  for (const char byte : sequence.substr(1)) code_point = code_point << 6 | (static_cast<std::uint8_t>(byte) & 0x3fu);
  return code_point;
}

bool isControl(char32_t c) { return c < 0x20 || (c >= 0x7f && c < 0xa0); }

bool isLineSeparator(char32_t c) { return c == 0x2028 || c == 0x2029; }

/// Unicode property Bidi_Control.
bool isBidirectionalControl(char32_t c) {
  return c == 0x061c || c == 0x200e || c == 0x200f || (c >= 0x202a && c <= 0x202e) || (c >= 0x2066 && c <= 0x2069);
}

/// `\x1b`
std::string asByte(char32_t c) {
  char buffer[16];
  std::snprintf(buffer, sizeof buffer, "\\x%02x", static_cast<unsigned>(c));
  return buffer;
}

/// `\u202e`
std::string asCodePoint(char32_t c) {
  char buffer[16];
  std::snprintf(buffer, sizeof buffer, "\\u%04x", static_cast<unsigned>(c));
  return buffer;
}

using Escape = std::string (*)(char32_t);

std::string escaped(std::string_view text, std::string_view kept_controls, Escape control) {
  std::string printable;
  printable.reserve(text.size());
  while (!text.empty()) {
    const std::size_t length = utf8SequenceLength(text);
    const std::string_view sequence = text.substr(0, std::max<std::size_t>(length, 1));
    text.remove_prefix(sequence.size());
    if (length == 0) {
      printable += asByte(static_cast<std::uint8_t>(sequence[0]));
      continue;
    }
    const char32_t c = decode(sequence);
    const bool is_kept = length == 1 && kept_controls.find(sequence[0]) != std::string_view::npos;
    if (isControl(c) && !is_kept) {
      printable += control(c);
    } else if (isLineSeparator(c) || isBidirectionalControl(c)) {
      printable += asCodePoint(c);
    } else {
      printable += sequence;
    }
  }
  return printable;
}

bool isContinuation(char byte) { return (static_cast<std::uint8_t>(byte) & 0xc0) == 0x80; }

}  // namespace

std::string printableText(std::string_view text) { return escaped(text, "", asByte); }

std::string printableLines(std::string_view text) { return escaped(text, "\n\t", asByte); }

std::string printableJson(std::string_view json) { return escaped(json, "\n\t", asCodePoint); }

std::string shortened(std::string_view text, std::size_t max_bytes) {
  if (text.size() <= max_bytes) return std::string(text);
  // A UTF-8 character has at most three continuation bytes; more of them are no UTF-8, and are cut anywhere.
  std::size_t head = max_bytes - max_bytes / 3;
  for (int i = 0; i < 3 && head > 0 && isContinuation(text[head]); ++i) --head;
  std::size_t tail = text.size() - max_bytes / 3;
  for (int i = 0; i < 3 && tail < text.size() && isContinuation(text[tail]); ++i) ++tail;
  return std::string(text.substr(0, head)) + " … (" + std::to_string(tail - head) + " bytes omitted) … " +
         std::string(text.substr(tail));
}

std::string quotable(std::string_view value) { return printableText(shortened(value, kMaxQuotedBytes)); }

}  // namespace robosim
