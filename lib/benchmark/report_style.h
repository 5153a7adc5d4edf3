#pragma once
#include <string>

namespace robosim {

/// CSS of a report's page, except that of its charts.
std::string reportStyle();
/// Makes the tables of a page sortable by a click on a column's name.
std::string reportScript();

}  // namespace robosim
