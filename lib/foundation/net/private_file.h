#pragma once
#include <filesystem>
#include <string>

namespace robosim {

/// Reads a file that contains a secret. No error quotes its content.
/// @param what description of the file for errors: "the tokens' file"
/// @throws ConfigError when it cannot be read, is larger than 1 MiB, or when other users than its owner may read it.
std::string readPrivateFile(const std::filesystem::path& file, const std::string& what);

/// Reads a file that all users may read, such as a certificate.
/// @throws ConfigError when it cannot be read, or is larger than 1 MiB.
std::string readSmallFile(const std::filesystem::path& file, const std::string& what);

}  // namespace robosim
