#pragma once
#include <cstddef>
#include <optional>
#include <string>

namespace robosim {

/// The content of a map file that is compressed with gzip; nullopt for one that is not.
/// @param path names the file in errors
/// @throws ConfigError for a damaged file, and for one with more than `max_bytes`
std::optional<std::string> unpackedMap(const std::string& bytes, const std::string& path, std::size_t max_bytes);

}  // namespace robosim
