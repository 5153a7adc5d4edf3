#include "tests/scenarios/permission_table.h"

#include <algorithm>
#include <sstream>
#include <stdexcept>

#include "tests/scenarios/program.h"

namespace robosim {
namespace {

/// "| a | `b` |" → {"a", "b"}; empty for other lines.
std::vector<std::string> cellsOf(const std::string& line) {
  std::vector<std::string> cells;
  if (!line.starts_with("|")) return cells;
  std::istringstream rest(line.substr(1));
  for (std::string cell; std::getline(rest, cell, '|');) {
    std::erase(cell, '`');
    const auto begin = cell.find_first_not_of(' ');
    const auto end = cell.find_last_not_of(' ');
    cells.push_back(begin == std::string::npos ? "" : cell.substr(begin, end - begin + 1));
  }
  return cells;
}

}  // namespace

PermissionTable permissionTable(const std::string& first_head) {
  std::istringstream lines(textOf(ROBOSIM_SOURCE_DIR "/doc/security.md"));
  std::vector<std::string> heads;
  PermissionTable table;
  for (std::string line; std::getline(lines, line);) {
    const auto cells = cellsOf(line);
    if (heads.empty()) {
      if (!cells.empty() && cells.front() == first_head) heads = cells;
      continue;
    }
    if (cells.empty()) break;
    if (cells.front().starts_with("---")) continue;
    if (cells.size() != heads.size()) throw std::runtime_error("doc/security.md: not a row of the table: " + line);
    for (std::size_t i = 1; i < cells.size(); ++i) table[cells.front()][heads[i]] = cells[i];
  }
  if (table.empty()) throw std::runtime_error("doc/security.md has no table whose first column is " + first_head);
  return table;
}

}  // namespace robosim
