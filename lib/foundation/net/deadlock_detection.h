#pragma once

namespace robosim {

/// Disables the deadlock detection of Abseil's mutexes, which gRPC uses; Debian builds Abseil with it enabled, at a
/// cost for each lock. Call before the first connection is made; may be called again.
void disableDeadlockDetection();

}  // namespace robosim
