#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <mrpt/math/TPose2D.h>

#include "replay/recorded_series.h"
#include "robots/fleet.h"
#include "run/outputs/simulation_recording.h"

namespace robosim {

struct RgbPicture {
  std::size_t rows = 0, columns = 0;
  std::vector<std::uint8_t> values;  ///< by row and column: red, green, blue
};

/// A recording's series, as of RecordingContents.
struct SeriesOfRecording {
  std::vector<RecordedSeries> series;
  std::optional<std::string> read_error;
  bool is_damaged = false;
};

/// Functions for the Python package, which loads kProgramLibrary when it calls the first of them.
struct FileFunctions {
  decltype(&recordSimulation) record = nullptr;
  /// Plan of a world with its robots at some poses, and the same as an SVG document
  RgbPicture (*plan)(const World&, const Fleet&, std::span<const mrpt::math::TPose2D> world_from_robot) = nullptr;
  std::string (*plan_svg)(const World&, const Fleet&, std::span<const mrpt::math::TPose2D> world_from_robot) = nullptr;
  /// As readRecording().
  SeriesOfRecording (*read)(const std::string& file, const std::function<void(std::uint64_t)>& progress) = nullptr;
};

}  // namespace robosim

/// In kProgramLibrary (run/loaded_parts.h).
extern "C" robosim::FileFunctions robosimFileFunctions();
