#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <mrpt/obs/CObservation.h>

#include "recording/unpacked_file.h"

namespace robosim {

/// Reads an MRPT rawlog, ours or anybody's, one observation after another. Sensory frames are taken apart; of actions,
/// the increments of the odometry are added up and come as CObservationOdometry with the label kFromActions. What else
/// a rawlog may hold is counted and left out.
///
/// Where a file is cut off or damaged, what stands before that place is read, and trouble() tells the rest.
class RawlogReader {
 public:
  using Places = UnpackedFile::Places;

  /// @param places keep: for a reader that is to seek()
  /// @throws ConfigError when there is no such file, it cannot be read, or it does not begin as a rawlog does.
  explicit RawlogReader(const std::filesystem::path& file, Places places = Places::forget);
  ~RawlogReader();
  RawlogReader(const RawlogReader&) = delete;
  RawlogReader& operator=(const RawlogReader&) = delete;

  /// The next one, in the file's order; null at the end.
  mrpt::obs::CObservation::Ptr next();

  /// Where the object begins that the last observation came from or with; for seek().
  std::uint64_t position() const;
  /// Goes back, or on, to an object that was read before: next() gives its first observation. Odometry from actions is
  /// then of no use, for it goes on being added up; and entries() and leftOut() count on.
  void seek(std::uint64_t position);

  /// Why the end came early; nullopt for a file that was read to its end.
  const std::optional<std::string>& trouble() const;
  /// Objects of the file so far.
  std::uint64_t entries() const;
  /// Of these, those that are neither observation nor action nor frame.
  std::uint64_t leftOut() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// The label of an odometry that was added up from actions.
inline constexpr const char* kFromActions = "odometry";

/// "robot1/sonar" → robot1, sonar; a label without a robot has an empty one. "robot1/sonar/POINTS" → robot1,
/// sonar/POINTS.
struct LabelParts {
  std::string robot, sensor;
};
LabelParts partsOf(const std::string& label);

}  // namespace robosim
