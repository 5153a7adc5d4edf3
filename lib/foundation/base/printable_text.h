#pragma once
#include <string>
#include <string_view>

namespace robosim {

/// A text from a file, a peer or a command line as one line that is safe to print on a terminal or in a log.
/// Control characters (C0, DEL, C1) and bytes that are not well-formed UTF-8 become `\x1b`; line separators (U+2028,
/// U+2029) and bidirectional control characters (Unicode property Bidi_Control) become `\u202e`. All other text is
/// unchanged, so that the function is idempotent.
std::string printableText(std::string_view text);

/// As printableText(), but line feeds and tabs stay.
std::string printableLines(std::string_view text);

/// A serialised JSON document without raw control or bidirectional characters: the same JSON value, with those
/// characters as `\u009b`. JSON allows them inside strings only, where the two forms are equivalent.
/// @param json well-formed UTF-8
std::string printableJson(std::string_view json);

/// A text of at most about `max_bytes`: of a longer one the beginning and the end, with the number of bytes omitted
/// between them. Cuts between UTF-8 characters.
std::string shortened(std::string_view text, std::size_t max_bytes);

/// Longest quotation of a single value in an error message [bytes].
constexpr std::size_t kMaxQuotedBytes = 100;
/// A value from a file or a command line as an error message quotes it: printableText(), shortened to kMaxQuotedBytes.
std::string quotable(std::string_view value);

}  // namespace robosim
