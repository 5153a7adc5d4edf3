#include "net/robot_wire.h"

#include <algorithm>
#include <cmath>

#include "hardware/blank_measurement.h"

namespace robosim {
namespace {

static_assert(static_cast<int>(Activity::active) == wire::ACTIVE &&
              static_cast<int>(Activity::halted) == wire::HALTED && static_cast<int>(Activity::found) == wire::FOUND);

void checkRobot(std::uint32_t robot, std::size_t robots, const char* what) {
  if (robot < robots) return;
  throw WireError(std::string(what) + " for robot " + std::to_string(robot) + " of " + std::to_string(robots) +
                  "; a connection speaks only for the robots of its hello, counted from 0");
}

void checkFinite(double value, const char* name, std::uint32_t robot) {
  if (std::isfinite(value)) return;
  throw WireError("the command for robot " + std::to_string(robot) + " has a " + name + " of " + std::to_string(value) +
                  "; it must be a finite number");
}

/// Fills `out`, of its size, from 4 floats an echo.
void decodeEchoes(const wire::Measurement& in, Echoes& out) {
  static_assert(sizeof(Echo) == 4 * sizeof(float));
  if (static_cast<std::size_t>(in.echoes_size()) != 4 * out.size()) {
    throw WireError("a reading of " + std::to_string(in.echoes_size()) + " floats for " + std::to_string(out.size()) +
                    " beams; each has four");
  }
  for (std::size_t i = 0; i < out.size(); ++i) {
    const float* of = in.echoes().data() + 4 * i;
    if (std::any_of(of, of + 4, [](float f) { return std::isnan(f); })) throw WireError("an echo is not a number");
    out[i] = {of[0], {of[1], of[2], of[3]}};
  }
}

void checkNumbers(const wire::Measurement& in, int count) {
  if (in.numbers_size() != count) {
    throw WireError("a reading of " + std::to_string(in.numbers_size()) + " numbers where " + std::to_string(count) +
                    " belong");
  }
  for (const double number : in.numbers()) {
    if (!std::isfinite(number)) throw WireError("a reading that is not a finite number");
  }
}

void checkJpeg(const std::string& jpeg) {
  if (jpeg.empty()) return;
  if (jpeg.size() > kPictureBytesMax) {
    throw WireError("a picture of " + std::to_string(jpeg.size()) + " bytes; the most is " +
                    std::to_string(kPictureBytesMax));
  }
  if (!jpeg.starts_with("\xFF\xD8") || !jpeg.ends_with("\xFF\xD9")) throw WireError("a picture that is no JPEG file");
}

void checkBlob(const wire::Blob& blob) {
  const auto side = [](std::uint32_t from, std::uint32_t size, float middle) {
    return from <= kPictureSideMax_px && size <= kPictureSideMax_px - from && std::isfinite(middle) &&
           middle >= static_cast<float>(from) && middle <= static_cast<float>(from + size);
  };
  const std::uint64_t most = std::uint64_t{blob.width_px()} * blob.height_px();
  if (side(blob.left_px(), blob.width_px(), blob.x_px()) && side(blob.top_px(), blob.height_px(), blob.y_px()) &&
      blob.pixels() <= most) {
    return;
  }
  throw WireError("a blob that is in no picture");
}

struct Decoder {
  const wire::Measurement& in;
  void operator()(Echoes& echoes) const { decodeEchoes(in, echoes); }
  void operator()(Scalar& scalar) const {
    checkNumbers(in, 1);
    scalar.value = in.numbers(0);
  }
  void operator()(Contacts& contacts) const {
    if (in.pressed().size() != contacts.pressed.size()) {
      throw WireError("a reading of " + std::to_string(in.pressed().size()) + " segments for a bumper of " +
                      std::to_string(contacts.pressed.size()));
    }
    if (in.pressed().find_first_not_of(std::string("\0\1", 2)) != std::string::npos) {
      throw WireError("a bumper's segment that is neither 0 nor 1");
    }
    std::copy(in.pressed().begin(), in.pressed().end(), contacts.pressed.begin());
  }
  void operator()(Odometry& odometry) const {
    checkNumbers(in, 5);
    odometry = {{in.numbers(0), in.numbers(1), in.numbers(2)}, in.numbers(3), in.numbers(4)};
  }
  void operator()(Image& image) const {
    checkJpeg(in.jpeg());
    image.jpeg = in.jpeg();
  }
  void operator()(Blobs& blobs) const {
    blobs.taken = in.blobs_size() != 0;
    if (blobs.taken && static_cast<std::size_t>(in.blobs_size()) != blobs.of_color.size()) {
      throw WireError("a reading of " + std::to_string(in.blobs_size()) + " blobs for a blob finder of " +
                      std::to_string(blobs.of_color.size()) + " colours");
    }
    for (std::size_t i = 0; i < blobs.of_color.size(); ++i) {
      const wire::Blob& blob = blobs.taken ? in.blobs(static_cast<int>(i)) : wire::Blob::default_instance();
      checkBlob(blob);
      blobs.of_color[i] = {std::move(blobs.of_color[i].color),
                           blob.pixels(),
                           blob.x_px(),
                           blob.y_px(),
                           blob.left_px(),
                           blob.top_px(),
                           blob.width_px(),
                           blob.height_px()};
    }
  }
};

struct Encoder {
  wire::Measurement& out;
  void operator()(const Echoes& echoes) const {
    out.mutable_echoes()->Resize(static_cast<int>(4 * echoes.size()), 0);
    float* to = out.mutable_echoes()->mutable_data();
    for (const Echo& echo : echoes) {
      *to++ = echo.range_m;
      *to++ = echo.point_m.x;
      *to++ = echo.point_m.y;
      *to++ = echo.point_m.z;
    }
  }
  void operator()(const Scalar& scalar) const { out.add_numbers(scalar.value); }
  void operator()(const Contacts& contacts) const {
    out.mutable_pressed()->assign(contacts.pressed.begin(), contacts.pressed.end());
  }
  void operator()(const Odometry& odometry) const {
    const auto& pose = odometry.odom_from_robot;
    for (const double n : {pose.x, pose.y, pose.phi, odometry.speed_mps, odometry.turn_radps}) out.add_numbers(n);
  }
  void operator()(const Image& image) const { out.set_jpeg(image.jpeg); }
  void operator()(const Blobs& blobs) const {
    if (!blobs.taken) return;
    for (const Blob& blob : blobs.of_color) {
      auto& to = *out.add_blobs();
      to.set_pixels(blob.pixels);
      to.set_x_px(blob.x_px);
      to.set_y_px(blob.y_px);
      to.set_left_px(blob.left_px);
      to.set_top_px(blob.top_px);
      to.set_width_px(blob.width_px);
      to.set_height_px(blob.height_px);
    }
  }
};

void encode(const RobotMessage& letter, wire::InboxLetter& out) {
  out.set_from(letter.from);
  out.set_text(letter.text);
}

}  // namespace

void encode(const Command& command, std::uint32_t robot, wire::RobotCommand& out) {
  out.set_robot(robot);
  out.set_speed_mps(command.speed_mps);
  out.set_turn_radps(command.turn_radps);
  out.set_laser_pan_rad(command.laser_pan_rad);
  out.set_activity(static_cast<wire::Activity>(command.activity));
  out.set_by_driver(command.by_driver);
}

Command decode(const wire::RobotCommand& in, std::size_t robots) {
  checkRobot(in.robot(), robots, "a command");
  checkFinite(in.speed_mps(), "speed_mps", in.robot());
  checkFinite(in.turn_radps(), "turn_radps", in.robot());
  checkFinite(in.laser_pan_rad(), "laser_pan_rad", in.robot());
  if (!wire::Activity_IsValid(in.activity())) {
    throw WireError("the command for robot " + std::to_string(in.robot()) + " has the activity " +
                    std::to_string(in.activity()) + "; there are 0 (active), 1 (halted) and 2 (found)");
  }
  return {in.speed_mps(), in.turn_radps(), in.laser_pan_rad(), static_cast<Activity>(in.activity()), in.by_driver()};
}

void decode(const wire::FromRobots& in, std::size_t robots, RobotsAnswer& out) {
  out.step = in.step();
  out.orders.clear();
  for (const auto& command : in.commands()) out.orders.push_back({command.robot(), decode(command, robots)});
  out.letters.clear();
  for (const auto& letter : in.letters()) {
    checkRobot(letter.robot(), robots, "a letter");
    if (letter.text().size() > kMaxMessageBytes) {
      throw WireError("a letter of " + std::to_string(letter.text().size()) + " bytes; the most is " +
                      std::to_string(kMaxMessageBytes));
    }
    out.letters.push_back({letter.robot(), letter.to(), letter.text()});
  }
  out.win_checks.assign(in.check_win().begin(), in.check_win().end());
  for (const auto robot : out.win_checks) checkRobot(robot, robots, "a question whether it has won");
}

void encode(const Measurement& measurement, wire::Measurement& out) {
  out.Clear();
  std::visit(Encoder{out}, measurement);
}

void decode(const wire::Measurement& in, Measurement& out) { std::visit(Decoder{in}, out); }

void encode(const Readings& readings, wire::RobotReadings& out) {
  out.Clear();
  for (const auto& measurement : readings.measurements) encode(measurement, *out.add_measurements());
  out.set_stalled(readings.stalled);
  out.set_laser_pan_rad(readings.laser_pan_rad);
  out.set_is_too_far(readings.is_too_far);
  for (const auto& letter : readings.inbox) encode(letter, *out.add_inbox());
}

void encodeInbox(const std::vector<RobotMessage>& letters, wire::RobotReadings& out) {
  const google::protobuf::RepeatedPtrField<wire::InboxLetter> later = out.inbox();
  out.clear_inbox();
  for (const auto& letter : letters) encode(letter, *out.add_inbox());
  for (const auto& letter : later) *out.add_inbox() = letter;
}

void decode(const wire::RobotReadings& in, const std::string& to, Readings& out) {
  if (static_cast<std::size_t>(in.measurements_size()) != out.measurements.size()) {
    throw WireError("readings of " + std::to_string(in.measurements_size()) + " sensors for a robot that has " +
                    std::to_string(out.measurements.size()));
  }
  for (int i = 0; i < in.measurements_size(); ++i) {
    decode(in.measurements(i), out.measurements[static_cast<std::size_t>(i)]);
  }
  out.stalled = in.stalled();
  out.laser_pan_rad = in.laser_pan_rad();
  out.is_too_far = in.is_too_far();
  out.inbox.clear();
  for (const auto& letter : in.inbox()) out.inbox.push_back({letter.from(), to, letter.text()});
}

Readings blankReadings(const std::vector<SensorInfo>& sensors) {
  Readings readings;
  for (const auto& sensor : sensors) readings.measurements.push_back(blankMeasurement(sensor));
  return readings;
}

}  // namespace robosim
