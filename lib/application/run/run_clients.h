#pragma once
#include <nlohmann/json_fwd.hpp>

#include "base/text_table.h"
#include "environment/run_report.h"

namespace robosim {

/// Client statistics in the summary of a served run: lost robots, geometry workers, lost messages.
nlohmann::ordered_json clientsJson(const RunReport& report);
/// Adds a row for each non-empty statistic.
void addClients(const RunReport& report, Rows& rows);

}  // namespace robosim
