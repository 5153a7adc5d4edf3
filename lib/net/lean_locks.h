#pragma once

namespace robosim {

/// gRPC's locks are Abseil's, and Debian builds these as for debugging: each looks for deadlocks whenever it is taken.
/// This has them leave that. Call before the first connection is made; it may be called again.
void useLeanLocks();

}  // namespace robosim
