#pragma once
#include <map>
#include <string>
#include <vector>

namespace robosim {

/// A table of doc/security.md: by the first cell of a row (without backquotes), the other cells by column head. The
/// documentation is the expected value of the tests, so that both always agree.
using PermissionTable = std::map<std::string, std::map<std::string, std::string>>;

/// @param first_head the head of the table's first column
/// @throws std::runtime_error when there is no such table, or a row has another number of cells
PermissionTable permissionTable(const std::string& first_head);

}  // namespace robosim
