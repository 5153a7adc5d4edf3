#pragma once
#include <string>
#include <vector>

#include "environment/run_report.h"
#include "robosim/v1/control_panel.pb.h"
#include "server/served_run.h"

namespace robosim {

/// @file
/// Parts of the status of a run that control panels receive.

/// World, time, robots, winner and recording.
void describeRun(const ServedRun& run, v1::RunStatus& status);
/// What has happened to processes of robots and to geometry workers.
void describeReport(const RunReport& report, v1::RunStatus& status);
/// @param names of the robots that are not connected, of which the status contains the first 100
void describeAbsent(const std::vector<std::string>& names, v1::RunStatus& status);

}  // namespace robosim
