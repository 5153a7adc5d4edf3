#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "robosim_bench/rounds.h"

namespace robosim {

/// A run without a recording and with one of each kind.
struct RunToRecord {
  std::filesystem::path world;
  std::string controller;  ///< as RunOptions::controller
  double time_s = 1800;    ///< at most; the run also ends when all robots have halted
};

/// worlds/opho2_1.xml: four robots with the gold finder, from the start until all have halted.
RunToRecord smallRun();

/// Cost of a simulated second, including a complete recording to memory, as `robosim run --record` makes it.
struct RecordingFigures {
  Cost plain, rawlog, mcap;
  double rawlog_bytes = 0, mcap_bytes = 0;  ///< per simulated second
};
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(RecordingFigures, plain, rawlog, mcap, rawlog_bytes, mcap_bytes)

/// Measured alternately, one thread besides that of the recording, in a separate process.
RecordingFigures benchRecording(const RunToRecord& run, double min_s);

}  // namespace robosim
