#pragma once
#include "serving/foxglove_serving.h"
#include "viewing/view_outputs.h"
#include "viewing/view_source.h"

namespace robosim {

/// Serves a source to Foxglove, with the topics of its robots and its world, until the process is interrupted. Clients
/// pause, step and change the speed, and go to any time of a recording, as far as the source and their tokens permit
/// it; they do not drive.
/// @param options of which FoxgloveOptions::is_realtime is set here
/// @throws std::runtime_error when the port cannot be opened; ConnectionError, RecordingError
void serveView(ViewSource& source, FoxgloveOptions options, const ViewTimes& times);

}  // namespace robosim
