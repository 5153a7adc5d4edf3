#pragma once
#include <cstddef>
#include <string_view>

namespace robosim {

/// Whether a text is well-formed UTF-8 (RFC 3629).
bool isUtf8(std::string_view text);

/// The longest prefix of `text` that has at most `max_bytes` bytes and ends between two code points.
/// @pre `text` is well-formed UTF-8; of any other text the prefix may end inside a sequence.
std::string_view utf8Prefix(std::string_view text, std::size_t max_bytes);

/// Length [bytes] of the well-formed UTF-8 sequence at the beginning of a text; 0 when there is none.
std::size_t utf8SequenceLength(std::string_view text);

}  // namespace robosim
