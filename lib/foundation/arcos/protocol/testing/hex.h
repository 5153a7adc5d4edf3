#pragma once
#include <string>
#include <string_view>

namespace robosim::arcos {

/// "fa fb 03", for expectations.
std::string hex(std::string_view bytes);
/// The bytes of such a text.
std::string fromHex(std::string_view text);

}  // namespace robosim::arcos
