#pragma once
#include <filesystem>
#include <string>

namespace robosim {

/// The whole text of a file that holds a secret. What it says appears in no error.
/// @param what it is, for errors: "the tokens' file"
/// @throws ConfigError when it cannot be read, is larger than 1 MiB, or when anyone but its owner may read it.
std::string readPrivateFile(const std::filesystem::path& file, const std::string& what);

/// The same of a file that anyone may read, as a certificate.
/// @throws ConfigError when it cannot be read, or is larger than 1 MiB.
std::string readSmallFile(const std::filesystem::path& file, const std::string& what);

}  // namespace robosim
