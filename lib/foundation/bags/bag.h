#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace robosim {

/// A topic of a recording of ROS 2.
struct BagTopic {
  std::string name;      ///< "/robot1/scan"
  std::string type;      ///< "sensor_msgs/msg/LaserScan"; empty for none
  std::string encoding;  ///< of its messages: "cdr" of ROS 2, "ros1", "json", …
};

/// Where a message is: the record of its chunk in an MCAP file and the record within, or the row of a database.
struct BagPlace {
  std::uint64_t record = 0, within = 0;
  std::uint32_t file = 0;  ///< index of the file, of a recording in several
  bool operator==(const BagPlace&) const = default;
};

struct BagMessage {
  std::size_t topic = 0;  ///< in Bag::topics()
  std::int64_t log_time_ns = 0;
  BagPlace place;
  std::span<const std::uint8_t> data;  ///< valid until the next call
};

/// A file of a recording of ROS 2, by any program.
class BagFile {
 public:
  virtual ~BagFile() = default;

  /// The topics of the messages that have been read so far, or of all.
  virtual const std::vector<BagTopic>& topics() const = 0;
  /// The next message in the order of the file; nullopt at the end. @throws Interrupted
  virtual std::optional<BagMessage> next() = 0;
  /// A message that next() has returned; nullopt when it cannot be read any more.
  virtual std::optional<BagMessage> at(const BagPlace& place) = 0;
  /// Why reading has ended before the end of the data; empty for none.
  virtual std::string fault() const = 0;
  /// Whether the reason is that the file ends too early.
  virtual bool isCutOff() const = 0;
};

/// @name Files of one kind
/// @throws ConfigError as InputFile does, and for a file of another kind
///@{
std::unique_ptr<BagFile> openMcapBag(const std::filesystem::path& file);
/// Of rosbag2's storage in SQLite (.db3). Tables: https://github.com/ros2/rosbag2, rosbag2_storage_sqlite3.
std::unique_ptr<BagFile> openSqliteBag(const std::filesystem::path& file);
///@}

/// A recording of ROS 2: an MCAP file, a database of rosbag2 (.db3), or a folder of them.
class Bag {
 public:
  /// @throws ConfigError for a file of another kind, a folder without such files, and compressed files of rosbag2
  explicit Bag(const std::filesystem::path& bag);

  const std::vector<BagTopic>& topics() const { return topics_; }
  /// As of BagFile, of one file after the other.
  std::optional<BagMessage> next();
  std::optional<BagMessage> at(const BagPlace& place);
  /// Why the end of a file could not be read, with its name if there are several; empty for none.
  const std::string& fault() const { return fault_; }
  /// Whether a file has wrong bytes, rather than ending too early.
  bool isDamaged() const { return is_damaged_; }

 private:
  struct File {
    std::filesystem::path path;
    std::unique_ptr<BagFile> bag;
    std::vector<std::size_t> topics;  ///< in topics_, of those of the file
  };

  BagMessage taken(std::uint32_t file, BagMessage message);

  std::vector<File> files_;
  std::uint32_t file_ = 0;  ///< of next()
  std::vector<BagTopic> topics_;
  std::string fault_;
  bool is_damaged_ = false;
};

/// The files of a folder of rosbag2 in order: those that metadata.yaml names or, without it, all .mcap and .db3.
/// @throws ConfigError for none, and for files that rosbag2 has compressed
std::vector<std::filesystem::path> bagFilesIn(const std::filesystem::path& folder);

}  // namespace robosim
