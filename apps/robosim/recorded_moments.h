#pragma once
#include <memory>
#include <string>
#include <vector>

#include "rendering/shown.h"
#include "robots/world_source.h"

namespace robosim {

/// The moments of a recording. It is read through once, and of each moment only a few numbers are kept, whatever the
/// robots measured; when a moment is to be shown, it is read again.
class RecordedMoments {
 public:
  virtual ~RecordedMoments() = default;

  /// Of RoboSim's recordings, the one that was run; of others, robots and nothing else.
  virtual const LoadedWorld& world() const = 0;
  /// When each was [s], in the order of time; there is at least one.
  virtual const std::vector<double>& times() const = 0;
  /// @throws RecordingError when the file is no longer what it was.
  virtual Shown at(std::size_t moment) = 0;
  /// Why the end came early, and what was left out; empty for a whole file.
  virtual const std::string& trouble() const = 0;
};

/// RoboSim's own, or anybody's.
/// @throws ConfigError as RawlogReader does, or when nothing in it can be shown.
std::unique_ptr<RecordedMoments> readMoments(const std::string& file);

}  // namespace robosim
