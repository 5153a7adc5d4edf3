#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "base/interrupt.h"
#include "recording/rawlog_reader.h"
#include "rendering/figure_page.h"
#include "robots/robot_selection.h"
#include "robots/view_layers.h"
#include "topics/robot_topics.h"

namespace robosim {

/// Form of a recording for other programs; doc/rawlog.md specifies them.
enum class RecordingFormat {
  csv,      ///< comma-separated values, one row per robot and step
  npz,      ///< NumPy's arrays, for each robot and sensor
  mcap,     ///< MCAP with the topics of ROS 2, of recordings of RoboSim only
  rawlog,   ///< MRPT rawlog with embedded pictures
  picture,  ///< a figure of the run; PNG, SVG or PDF according to the file name
  page,     ///< an interactive page of the run, in one HTML file
};

/// One of the files of an export.
struct RecordingOutput {
  std::filesystem::path file;
  RecordingFormat format;
  RosDistribution distribution = RosDistribution::jazzy;  ///< of the messages of an MCAP file
};

/// Writes a recording as tables and figures. All files are renamed to their names after all have been written.
/// @param rawlog made by RoboSim or another program; may be a pipe
/// @param page size of figures
/// @param layers of figures, which have no sensors, and of pages at first @param only robots that figures and pages
/// show
/// @param threads with which the recording is read and a .csv is written; the files are the same
/// @param interrupt a request ends the export; null: it cannot be interrupted
/// @returns false for the readable part of a damaged recording
/// @throws ConfigError, Interrupted, std::runtime_error (such as on a full disk); nothing is written then
bool exportRecording(const std::string& rawlog, const std::vector<RecordingOutput>& outs, const Interrupt* interrupt,
                     const FigurePage& page = {}, const ViewLayers& layers = {}, const RobotSelection& only = {},
                     int threads = threadsForReading());

}  // namespace robosim
