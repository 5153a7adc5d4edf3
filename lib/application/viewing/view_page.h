#pragma once
#include <string>

#include "live_page/live_page_server.h"
#include "viewing/view_source.h"

namespace robosim {

/// Shows a world or a served run on a page in browsers, until the process is interrupted. Users of the page pause the
/// run, set its speed, and move robots and objects, as far as the source and their tokens permit it.
/// @throws std::runtime_error when the port cannot be opened; ConnectionError
void serveViewPage(ViewSource& source, const LivePageServer::Options& options);

/// The same with a recording: each page receives all of it, as 'robosim export RUN run.html' writes it.
/// @param file made by RoboSim or another program
/// @returns false for the readable part of a damaged recording
/// @throws ConfigError, Interrupted, std::runtime_error
bool serveRecordingPage(const std::string& file, const LivePageServer::Options& options);

}  // namespace robosim
