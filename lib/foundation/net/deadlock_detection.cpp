#include "net/deadlock_detection.h"

#include <absl/synchronization/mutex.h>

namespace robosim {

void disableDeadlockDetection() { absl::SetMutexDeadlockDetectionMode(absl::OnDeadlockCycle::kIgnore); }

}  // namespace robosim
