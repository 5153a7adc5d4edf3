#include "recording/carmen/carmen_line.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "base/angle_units.h"

namespace robosim {
namespace {

using mrpt::math::TPose2D;

constexpr std::size_t kMaxReadings = 1 << 20;
/// Maximum of the scanners of old lines [m], which CARMEN assumes, too.
constexpr double kOldMax_m = 80;
/// Times [s] beyond this are no times since 1970.
constexpr double kMaxTime_s = 1e11;

/// The words of a line.
class Words {
 public:
  explicit Words(std::string_view line) {
    constexpr std::string_view space = " \t\r";
    while (true) {
      line.remove_prefix(std::min(line.find_first_not_of(space), line.size()));
      if (line.empty()) break;
      const std::string_view word = line.substr(0, line.find_first_of(space));
      words_.push_back(word);
      line.remove_prefix(word.size());
    }
    type_ = std::string(words_.at(0));
    at_ = 1;
  }

  const std::string& type() const { return type_; }
  std::size_t left() const { return words_.size() - at_; }
  std::string_view word(const char* what) {
    if (left() == 0) fail("ends before " + std::string(what));
    return words_[at_++];
  }
  bool isNumberAt(std::size_t ahead) const { return parsed<double>(words_[at_ + ahead]).has_value(); }

  double number(const char* what) {
    const auto text = word(what);
    const auto value = parsed<double>(text);
    if (!value || !std::isfinite(*value)) fail("'" + std::string(text) + "' is no number, for " + what);
    return *value;
  }
  TPose2D pose(const char* what) {
    const double x = number(what), y = number(what), phi = number(what);
    return {x, y, phi};
  }
  /// A count, and as many numbers.
  std::vector<float> list(const char* what) {
    const double count = number(what);
    if (count < 0 || count > kMaxReadings || count != std::floor(count)) {
      fail("has a wrong number of " + std::string(what));
    }
    const auto size = static_cast<std::size_t>(count);
    if (size > left()) {
      fail("announces " + std::to_string(size) + " " + what + ", but " + std::to_string(left()) + " numbers follow");
    }
    std::vector<float> values(size);
    for (auto& value : values) {
      const auto text = word(what);
      const auto read = parsed<float>(text);
      if (!read) fail("'" + std::string(text) + "' is no number, in its " + what);
      value = *read;
    }
    return values;
  }
  [[noreturn]] void fail(const std::string& what) const { throw std::runtime_error(type_ + ": " + what); }

 private:
  template <typename Number>
  static std::optional<Number> parsed(std::string_view text) {
    Number value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error == std::errc::result_out_of_range) return std::numeric_limits<Number>::infinity();
    return error == std::errc{} && end == text.data() + text.size() ? std::make_optional(value) : std::nullopt;
  }

  std::vector<std::string_view> words_;
  std::string type_;
  std::size_t at_ = 0;
};

void guessAngles(CarmenScan& scan) {
  const std::size_t count = scan.ranges_m.size();
  scan.is_guessed = true;
  scan.max_m = kOldMax_m;
  scan.first_rad = -M_PI / 2;
  if (count == 180 || count == 181) {
    scan.between_rad = toRadians(1);
  } else if (count == 360 || count == 361) {
    scan.between_rad = toRadians(0.5);
  } else if (count == 400 || count == 401) {
    scan.first_rad = toRadians(-50);
    scan.between_rad = toRadians(0.25);
  } else if (count > 1) {
    scan.between_rad = M_PI / static_cast<double>(count - 1);
  }
}

void readOldScan(Words& words, CarmenLine& line) {
  CarmenScan scan;
  scan.scanner = line.type == "FLASER" ? 1 : 2;
  scan.ranges_m = words.list("readings");
  guessAngles(scan);
  scan.odom_from_scanner = words.pose("the scanner's pose");
  line.odom_from_robot = words.pose("the odometry");
  line.scan = std::move(scan);
}

/// What RAWLASER and ROBOTLASER have in common, up to the readings.
CarmenScan readConfigured(Words& words, const std::string& type) {
  CarmenScan scan;
  scan.scanner = static_cast<unsigned>(type.back() - '0');
  words.number("the type of the scanner");
  scan.first_rad = words.number("the start angle");
  words.number("the field of view");
  scan.between_rad = words.number("the angular resolution");
  scan.max_m = words.number("the maximum range");
  words.number("the accuracy");
  words.number("the remission mode");
  scan.ranges_m = words.list("readings");
  if (!(scan.max_m > 0)) words.fail("has no maximum range above 0");
  return scan;
}

void readNewScan(Words& words, CarmenLine& line) {
  CarmenScan scan = readConfigured(words, line.type);
  // Before CARMEN had remissions, ten numbers followed, and the time, host and time of the logger.
  constexpr std::size_t old = 10;
  const bool is_old = words.left() == old || (words.left() == old + 3 && !words.isNumberAt(old + 1));
  if (!is_old) words.list("remissions");
  scan.odom_from_scanner = words.pose("the scanner's pose");
  line.odom_from_robot = words.pose("the robot's pose");
  for (int i = 0; i < (is_old ? 4 : 5); ++i) words.number("the speeds and safety distances");
  line.scan = std::move(scan);
}

void readTime(Words& words, CarmenLine& line) {
  if (words.left() == 0) return;
  const double time_s = words.number("the time");
  if (!(std::abs(time_s) <= kMaxTime_s)) words.fail("has a time that is no number of seconds since 1970");
  line.time_s = time_s;
  if (words.left() > 2) words.fail("has " + std::to_string(words.left() - 2) + " words too many");
}

bool isOneOf(std::string_view type, std::string_view stem, char last) {
  return type.size() == stem.size() + 1 && type.starts_with(stem) && type.back() >= '1' && type.back() <= last;
}

}  // namespace

CarmenLine parseCarmenLine(std::string_view text) {
  Words words(text);
  CarmenLine line;
  line.type = words.type();
  const auto is_of_name = [](unsigned char c) {
    return (std::isupper(c) || std::isdigit(c) || c == '_' || c == '-') != 0;
  };
  if (!std::all_of(line.type.begin(), line.type.end(), is_of_name)) {
    throw std::runtime_error("is no message of CARMEN, which begins with a name in capitals");
  }
  if (line.type == "SYNC") return line;
  if (line.type == "PARAM") {
    const std::string name(words.word("the name")), value(words.word("the value"));
    line.param = {name, value};
    return line;
  }
  if (line.type == "FLASER" || line.type == "RLASER") {
    readOldScan(words, line);
  } else if (isOneOf(line.type, "ROBOTLASER", '2')) {
    readNewScan(words, line);
  } else if (isOneOf(line.type, "RAWLASER", '5')) {
    line.scan = readConfigured(words, line.type);
    words.list("remissions");
  } else if (line.type == "ODOM") {
    line.odom_from_robot = words.pose("the odometry");
    const double speed_mps = words.number("the speed"), turn_radps = words.number("the turn rate");
    line.speeds = {speed_mps, turn_radps};
    words.number("the acceleration");
  } else if (line.type == "TRUEPOS") {
    line.world_from_robot = words.pose("the true pose");
    words.pose("the odometry");
  } else {
    line.is_unread = true;
    return line;
  }
  if (line.scan && line.scan->ranges_m.empty()) line.scan.reset();  // of a robot without a scanner
  readTime(words, line);
  return line;
}

}  // namespace robosim
