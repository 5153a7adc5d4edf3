#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace robosim {

/// A place of a robot's path, and what has changed of the robot there.
struct TracePoint {
  enum Flag : std::uint8_t {
    absent = 1,   ///< not in the world; x and y are 0
    stalled = 2,  ///< is stopped by an obstacle
    found = 4,    ///< has found gold
    sent = 8,     ///< a message that it has sent is received in this step
  };
  static constexpr std::uint32_t kMaxRobots = 1 << 24;

  std::uint32_t step = 0;  ///< after the first step of the member
  std::uint32_t robot = 0;
  float x_m = 0, y_m = 0;  ///< world frame
  std::uint8_t flags = 0;
  bool operator==(const TracePoint&) const = default;
};

/// What the index says of a member of the file.
struct MemberNote {
  enum Flag : std::uint32_t {
    comments = 1,    ///< of a step, such as interventions
    irregular = 2,   ///< its steps are not consecutive
    adds_robot = 4,  ///< a robot is in its steps, or one after the first, for the first time
  };

  std::uint64_t packed = 0;      ///< position of the member in the file
  std::uint64_t unpacked = 0;    ///< position of its content
  std::uint64_t first_step = 0;  ///< that begins in it
  std::uint32_t steps = 0;       ///< number of steps that begin in it
  std::uint32_t flags = 0;
  std::vector<TracePoint> points;  ///< ascending by step
};

/// What the index says of the whole recording.
struct IndexSummary {
  std::uint64_t unpacked = 0;  ///< size of the content
  bool has_traces = false;     ///< whether the points are of all robots and steps
  std::uint32_t robots = 0;    ///< number of robots with points, which are numbered in the order of their first one
};

/// Appends parts of the index's stream.
void appendTo(std::vector<std::uint8_t>& stream, const MemberNote& note);
void appendTo(std::vector<std::uint8_t>& stream, const IndexSummary& summary);

/// The index of a recording in a gzip file. It refers to members with content in their order.
struct MemberIndex {
  std::vector<MemberNote> members;  ///< without points
  IndexSummary summary;

  /// Reads the index of a complete file, in a time that is proportional to the number of its members.
  /// @param on_points called with each member that has points, in their order
  /// @return nullopt for a file without an index, or one that cannot be of this file. @throws ConfigError as InputFile
  static std::optional<MemberIndex> read(
      const std::filesystem::path& file,
      const std::function<void(const MemberNote&, std::span<const TracePoint>)>& on_points = {});
};

}  // namespace robosim
