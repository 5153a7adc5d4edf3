// The log of a ByteChannel: logChannel(), and the channel that replays one.
#include <algorithm>
#include <array>
#include <charconv>
#include <fstream>
#include <iomanip>
#include <optional>
#include <sstream>
#include <string_view>
#include <utility>

#include "arcos/client/open_channel.h"
#include "arcos/client/replayed_channel.h"
#include "base/error_list.h"
#include "base/input_file.h"
#include "base/interrupt.h"
#include "base/log.h"
#include "base/seconds.h"

namespace robosim {
namespace {

constexpr std::string_view kFirstLine = "RoboSim ARCOS log 1";
constexpr std::string_view kCapacity =
    ", bytes per second: ";  ///< continues the first line, for a line of limited speed

class LoggedChannel final : public ByteChannel {
 public:
  LoggedChannel(std::unique_ptr<ByteChannel> channel, const std::string& file)
      : channel_(std::move(channel)), file_name_(file), file_(file), start_(channel_->now()) {
    file_ << kFirstLine;
    if (const auto capacity = channel_->capacity()) file_ << kCapacity << *capacity;
    file_ << '\n';
    if (!file_.flush()) throw ConfigError(file + ": cannot be written; choose another file for --arcos-log");
  }

  std::string read(Clock::duration timeout) override {
    std::string bytes = channel_->read(timeout);
    if (!bytes.empty()) log('<', bytes);
    return bytes;
  }
  void write(std::string_view bytes) override {
    channel_->write(bytes);
    log('>', bytes);
  }
  Clock::time_point now() const override { return channel_->now(); }
  std::optional<double> capacity() const override { return channel_->capacity(); }
  const std::string& name() const override { return channel_->name(); }

 private:
  /// A disk that is full ends the log, and not the drive.
  void log(char direction, std::string_view bytes) {
    if (!file_) return;
    std::ostringstream line;
    line << std::fixed << std::setprecision(4) << toSeconds(now() - start_) << ' ' << direction << std::hex
         << std::setfill('0');
    for (const char byte : bytes) line << ' ' << std::setw(2) << unsigned{static_cast<unsigned char>(byte)};
    file_ << line.str() << '\n';
    if (!file_.flush())
      logWarning("robot", file_name_ + ": the log ends here, because it cannot be written; free some space");
  }

  std::unique_ptr<ByteChannel> channel_;
  std::string file_name_;
  std::ofstream file_;
  Clock::time_point start_;
};

/// Lines of a file of others, read as needed.
class BoundedLines {
 public:
  /// Maximum length of a line: 100,000 bytes of a robot, three characters each.
  static constexpr std::size_t kMaxLineBytes = 300'000;

  /// @throws ConfigError as InputFile does
  explicit BoundedLines(const std::string& file) : in_(file) {}

  /// The next line, without its end; nullopt at the end of the file. A line that is longer than kMaxLineBytes is
  /// returned in part, and too long. @throws Interrupted
  std::optional<std::string> next() {
    std::size_t end = text_.find('\n', begin_);
    while (end == std::string::npos && text_.size() - begin_ <= kMaxLineBytes) {
      throwIfInterrupted("the log was not read to its end");
      text_.erase(0, std::exchange(begin_, 0));
      const std::size_t searched = text_.size();
      std::array<char, 65536> block;
      const std::size_t got = in_.read(block.data(), block.size());
      if (got == 0) break;
      text_.append(block.data(), got);
      end = text_.find('\n', searched);
    }
    if (end == std::string::npos) {
      if (begin_ == text_.size()) return std::nullopt;
      end = text_.size();
    }
    std::string line = text_.substr(begin_, end - begin_);
    begin_ = std::min(end + 1, text_.size());
    return line;
  }

 private:
  InputFile in_;
  std::string text_;  ///< read and not returned, from begin_ on
  std::size_t begin_ = 0;
};

/// Plays a log: what the robot sent, each part when it is read. Its clock is that of the log.
class ReplayedChannel final : public ByteChannel {
 public:
  explicit ReplayedChannel(const std::string& file) : name_("replay:" + file), file_name_(file), lines_(file) {
    const auto first = lines_.next();
    if (!first || !isFirstLine(*first)) {
      throw ConfigError(file + ":1: is no log of --arcos-log: its first line is not '" + std::string(kFirstLine) + "'");
    }
  }

  std::string read(Clock::duration) override {
    while (const auto line = lines_.next()) {
      ++line_number_;
      if (line->size() > BoundedLines::kMaxLineBytes) fail();
      throwIfInterrupted("the log was not read to its end");
      if (auto bytes = receivedIn(*line)) return *bytes;
    }
    throw ChannelEnd(file_name_ + ": the log has ended");
  }
  void write(std::string_view) override {}
  Clock::time_point now() const override { return Clock::time_point{} + fromSeconds(time_s_); }
  std::optional<double> capacity() const override { return capacity_; }
  const std::string& name() const override { return name_; }

 private:
  bool isFirstLine(std::string_view line) {
    if (!line.starts_with(kFirstLine)) return false;
    line.remove_prefix(kFirstLine.size());
    if (line.empty()) return true;
    if (!line.starts_with(kCapacity)) return false;
    line.remove_prefix(kCapacity.size());
    double capacity = 0;
    const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), capacity);
    capacity_ = capacity;
    return error == std::errc{} && end == line.data() + line.size() && capacity > 0;
  }
  /// The bytes of a line; nullopt for those that were sent. @throws ConfigError
  std::optional<std::string> receivedIn(const std::string& line) {
    std::istringstream words(line);
    double time_s = 0;
    std::string direction;
    if (!(words >> time_s >> direction) || (direction != "<" && direction != ">")) fail();
    constexpr double kLongest_s = 1e9;
    if (!(time_s >= time_s_ && time_s <= kLongest_s)) fail();
    time_s_ = time_s;
    std::string bytes;
    for (std::string word; words >> word;) {
      unsigned byte = 0;
      const char* const end = word.data() + word.size();
      const auto [stop, error] = std::from_chars(word.data(), end, byte, 16);
      if (word.size() != 2 || error != std::errc{} || stop != end) fail();
      bytes.push_back(static_cast<char>(byte));
    }
    if (direction == ">") return std::nullopt;
    return bytes;
  }
  [[noreturn]] void fail() const {
    throw ConfigError(file_name_ + ":" + std::to_string(line_number_) +
                      ": is no line of an ARCOS log; it must be as in '0.1000 < fa fb 03 00 00 00'");
  }

  std::string name_, file_name_;
  BoundedLines lines_;
  std::optional<double> capacity_;  ///< of the line that was logged
  int line_number_ = 1;
  double time_s_ = 0;
};

}  // namespace

std::unique_ptr<ByteChannel> logChannel(std::unique_ptr<ByteChannel> channel, const std::string& file) {
  return std::make_unique<LoggedChannel>(std::move(channel), file);
}

std::unique_ptr<ByteChannel> replayChannel(const std::string& file) { return std::make_unique<ReplayedChannel>(file); }

}  // namespace robosim
