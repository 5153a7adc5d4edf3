#include "net/lean_locks.h"

#include <absl/synchronization/mutex.h>

namespace robosim {

void useLeanLocks() { absl::SetMutexDeadlockDetectionMode(absl::OnDeadlockCycle::kIgnore); }

}  // namespace robosim
