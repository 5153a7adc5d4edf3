#pragma once

namespace robosim {

/// Installs a handler for SIGHUP, which requests a reload of the token file instead of ending the program.
void catchReloadSignal();

/// Whether SIGHUP has been received since the last call.
bool isReloadRequested();

}  // namespace robosim
