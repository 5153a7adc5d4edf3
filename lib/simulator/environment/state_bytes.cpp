#include "environment/state_bytes.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <set>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include "base/digest.h"
#include "base/error_list.h"
#include "environment/command_bytes.h"
#include "environment/environment.h"
#include "environment/intervention_bytes.h"
#include "environment/measurement_bytes.h"
#include "environment/state_stream.h"
#include "hardware/measurement_fields.h"

namespace robosim {
namespace {

static_assert(std::endian::native == std::endian::little, "saved states are little-endian");

/// Line ends and ^Z detect a transfer as text, as in PNG files.
constexpr std::string_view kMagic = "RoboSim state\r\n\x1a";
constexpr std::uint32_t kVersion = 11;  ///< since 11, with heads of cameras
constexpr std::size_t kSizeAt = 20;     ///< after magic and version
constexpr std::size_t kHeaderBytes = 36;
constexpr std::size_t kChecksumBytes = sizeof(std::uint64_t);
constexpr double kFarthestPose_m = 1e7;

template <typename T>
T numberAt(std::string_view bytes, std::size_t place) {
  T number;
  std::memcpy(&number, bytes.data() + place, sizeof number);
  return number;
}

std::uint64_t computeChecksum(std::string_view bytes) {
  Digest digest;
  digest.addBytes(bytes.data(), bytes.size());
  return digest.value();
}

/// Whether the measurement has a flag that is set in steps in which the sensor measured.
template <typename M>
constexpr bool kHasPresenceFlag = requires(M& m) {
  Description<M>::isPresent(m) = true;
};

/// Writes a measurement; its kind and size follow from the model.
struct MeasurementWriter {
  StateWriter& out;

  template <typename M>
  void operator()(const M& measurement) const {
    using D = Description<M>;
    if constexpr (kHasPresenceFlag<M>) out.addNumber(std::uint8_t{D::isPresent(measurement)});
    if constexpr (kIsFile<M>) {
      out.addText(D::file(measurement));
    } else if constexpr (kIsDense<M>) {
      const auto records = D::records(measurement);
      out.addBytes(records.data(), records.size_bytes());
    } else {
      forNumbers(measurement, [&](const auto&, const auto& number, std::size_t) { out.addNumber(number); });
    }
  }
};

/// Fills a blank measurement.
struct MeasurementReader {
  StateReader& in;
  NumberCheck check;

  template <typename M>
  void operator()(M& measurement) const {
    using D = Description<M>;
    if constexpr (kHasPresenceFlag<M>) D::isPresent(measurement) = in.takeFlag();
    if constexpr (kIsFile<M>) {
      std::string file = in.takeText(kPictureBytesMax);
      if (file.empty()) return;
      try {
        D::setFile(measurement, std::move(file));
      } catch (const std::invalid_argument&) {
        requireContents(false, "a picture is no JPEG file");
      }
    } else {
      forNumbers(measurement, [&](const auto& field, auto& number, std::size_t) {
        number = in.takeNumber<std::remove_reference_t<decltype(number)>>();
        if (check == NumberCheck::none) return;
        requireContents(isPermitted(field, number), "a measurement is impossible");
      });
      if (check == NumberCheck::none) return;
      if constexpr (requires { D::faultOf(*D::records(measurement).begin()); }) {
        for (const auto& record : D::records(measurement))
          requireContents(!D::faultOf(record), "a record is impossible");
      }
    }
  }
};

}  // namespace

void writeMeasurements(const Readings& readings, StateWriter& out) {
  for (const Measurement& measurement : readings.measurements) std::visit(MeasurementWriter{out}, measurement);
}

void readMeasurements(StateReader& in, Readings& readings, NumberCheck check) {
  for (Measurement& measurement : readings.measurements) std::visit(MeasurementReader{in, check}, measurement);
}

namespace {

void writeRobot(const State& state, std::size_t i, StateWriter& out) {
  out.addPose(state.world_from_robot[i]);
  for (const double value : {state.speed_mps[i], state.turn_radps[i], state.last_motion[i].length_m,
                             state.last_motion[i].turn_rad, state.driven_m[i]}) {
    out.addNumber(value);
  }
  out.addNumber(state.last_motion[i].lateral_m);
  if (!state.drives.empty()) {
    out.addNumber(state.drives[i].lateral_mps);
    out.addNumber(state.drives[i].steering_rad);
  }
  out.addNumber(state.stalled[i]);
  out.addNumber(static_cast<std::uint8_t>(state.activity[i]));
  out.addNumber(state.laser_pan_rad[i]);

  writeCommand(state.commands[i], out);

  out.addNumber(state.win_requests[i]);
  static const Outbox kEmpty;
  const Outbox& outbox = state.outboxes[i] ? *state.outboxes[i] : kEmpty;
  out.addNumber(outbox.surplus);
  out.addNumber(static_cast<std::uint32_t>(outbox.messages.size()));
  for (const PendingMessage& message : outbox.messages) {
    out.addNumber(message.to);
    out.addText(message.text);
  }

  // The other members of the readings repeat members of the state.
  const Readings& readings = state.readings[i];
  writeMeasurements(readings, out);
  out.addNumber(std::uint8_t{readings.is_too_far});
  out.addNumber(static_cast<std::uint32_t>(readings.inbox.size()));
  for (const RobotMessage& message : readings.inbox) {
    out.addText(message.from);
    out.addText(message.text);
  }
}

void readRobot(const Model& model, std::size_t i, StateReader& in, State& state) {
  const RobotInfo& info = model.fleet.robots[i].info;
  auto& pose = state.world_from_robot[i];
  pose = in.takePose();
  requireContents(std::abs(pose.x) <= kFarthestPose_m && std::abs(pose.y) <= kFarthestPose_m,
                  "a robot is too far away");
  state.speed_mps[i] = in.takeFinite();
  state.turn_radps[i] = in.takeFinite();
  requireContents(std::abs(state.speed_mps[i]) <= info.type->limits.speed_max_mps &&
                      std::abs(state.turn_radps[i]) <=
                          info.type->limits.turn_max_radps * std::max(1.0, info.type->drive.turnShare()),
                  "a robot is faster than its limits");
  state.last_motion[i].length_m = in.takeFinite();
  state.last_motion[i].turn_rad = in.takeFinite();
  state.driven_m[i] = in.takeFinite();
  state.last_motion[i].lateral_m = in.takeFinite();
  if (!state.drives.empty()) {
    state.drives[i].lateral_mps = in.takeFinite();
    state.drives[i].steering_rad = in.takeFinite();
    requireContents(std::abs(state.drives[i].lateral_mps) <= groundSpeedMax(info.type->drive, info.type->limits) &&
                        std::abs(state.drives[i].steering_rad) <= info.type->drive.steering_max_rad,
                    "a robot is faster than its limits");
  }
  state.stalled[i] = in.takeFlag() ? 1 : 0;
  state.activity[i] = in.takeActivity();
  state.laser_pan_rad[i] = in.takeNumber<float>();
  requireContents(std::isfinite(state.laser_pan_rad[i]), "a pan angle is not finite");
  state.commands[i] = readCommand(in);

  state.win_requests[i] = in.takeFlag() ? 1 : 0;
  const auto surplus = in.takeNumber<std::uint64_t>();
  const auto sent = in.takeNumber<std::uint32_t>();
  requireContents(sent <= kMaxMessagesSent, "a robot has sent too many messages");
  if (surplus > 0 || sent > 0) state.outboxes[i].emplace().surplus = surplus;
  for (std::uint32_t k = 0; k < sent; ++k) {
    PendingMessage& message = state.outboxes[i]->messages.emplace_back();
    message.to = in.takeNumber<std::uint32_t>();
    requireContents(message.to < model.fleet.robots.size() || message.isBroadcast(),
                    "a message has an unknown receiver");
    message.text = in.takeText(kMaxMessageBytes);
  }

  Readings& readings = state.readings[i];
  readMeasurements(in, readings, NumberCheck::permitted);
  if (const char* fault = pictureFaultOf(readings.measurements, *info.sensors)) requireContents(false, fault);
  readings.is_too_far = in.takeFlag();
  const auto received = in.takeNumber<std::uint32_t>();
  requireContents(received <= InboxLimit::kMaxMessages, "a robot has received too many messages");
  for (std::uint32_t k = 0; k < received; ++k) {
    RobotMessage& message = readings.inbox.edit().emplace_back();
    message.from = in.takeText(InboxLimit::kMaxBytes);
    message.to = info.name;
    message.text = in.takeText(kMaxMessageBytes);
  }
  readings.time = state.time;
  readings.stalled = state.stalled[i] != 0;
  readings.laser_pan_rad = state.laser_pan_rad[i];
}

void writeMessages(const State& state, StateWriter& out) {
  const MessageLosses& lost = state.messages_lost;
  for (const std::uint64_t number :
       {lost.out_of_range, lost.stopped_by_walls, lost.by_chance, lost.in_bursts, lost.absent}) {
    out.addNumber(number);
  }
  out.addNumber(static_cast<std::uint64_t>(state.messages_in_flight.size()));
  for (const MessageInFlight& message : state.messages_in_flight) {
    out.addNumber(message.from);
    out.addNumber(message.to);
    out.addNumber(message.due_step);
    out.addText(message.text);
  }
}

void readMessages(const Model& model, StateReader& in, State& state) {
  MessageLosses& lost = state.messages_lost;
  for (std::uint64_t* number :
       {&lost.out_of_range, &lost.stopped_by_walls, &lost.by_chance, &lost.in_bursts, &lost.absent}) {
    *number = in.takeNumber<std::uint64_t>();
  }
  // An intervention may have made the delay shorter since they were sent.
  const std::uint64_t last_step =
      state.time.step + std::max<std::uint64_t>(1, delaySteps({.delay_s = kDelayMax_s}, model.period_s));
  std::uint64_t earliest = state.time.step + 1;
  for (auto left = in.takeNumber<std::uint64_t>(); left > 0; --left) {
    MessageInFlight& message = state.messages_in_flight.emplace_back();
    message.from = in.takeNumber<std::uint32_t>();
    message.to = in.takeNumber<std::uint32_t>();
    message.due_step = in.takeNumber<std::uint64_t>();
    message.text = in.takeText(kMaxMessageBytes);
    requireContents(message.from < model.fleet.robots.size() && message.to < model.fleet.robots.size(),
                    "a message in flight has an unknown sender or receiver");
    requireContents(message.due_step >= earliest && message.due_step <= last_step,
                    "a message in flight arrives at an impossible time");
    earliest = message.due_step;
  }
}

/// Stands for a robot or a step that there is not.
constexpr std::uint64_t kNone = ~std::uint64_t{0};

void writeOutcome(const State& state, StateWriter& out) {
  for (const auto& event : {state.found, state.won}) {
    out.addNumber(event ? std::uint64_t{event->robot} : kNone);
    out.addNumber(event ? event->step : kNone);
  }
  out.addNumber(state.all_halted_step.value_or(kNone));
}

void readOutcome(const Model& model, StateReader& in, State& state) {
  constexpr const char* kImpossible = "the outcome is impossible";
  for (auto* event : {&state.found, &state.won}) {
    const auto robot = in.takeNumber<std::uint64_t>();
    const auto step = in.takeNumber<std::uint64_t>();
    if (robot == kNone && step == kNone) continue;
    requireContents(robot < model.fleet.robots.size() && step <= state.time.step, kImpossible);
    *event = RobotAtStep{static_cast<std::size_t>(robot), step};
  }
  if (const auto step = in.takeNumber<std::uint64_t>(); step != kNone) {
    requireContents(step <= state.time.step, kImpossible);
    state.all_halted_step = step;
  }
}

/// Writes the robots that were added, and the hash of each, which detects that its type is another now.
void writeAdditions(const Model& model, StateWriter& out) {
  const auto added = model.additions.list();
  out.addNumber(static_cast<std::uint32_t>(added.size()));
  const auto* robot = model.fleet.robots.data() + (model.fleet.robots.size() - added.size());
  for (const AddRobot& one : added) {
    out.addText(changeText(one));
    out.addNumber(digestOf(*robot++));
  }
}

/// The model of the state: the given one with the robots that were added.
std::shared_ptr<const Model> readAdditions(const Model& model, StateReader& in) {
  const auto count = in.takeNumber<std::uint32_t>();
  requireContents(count <= kAddedRobotsMax, "too many robots were added");
  if (count == 0) return withAdditions(model, {});
  std::set<std::string> names;
  for (std::size_t i = 0; i < model.fleet.robots.size() - model.additions.size(); ++i) {
    names.insert(model.fleet.robots[i].info.name);
  }
  std::vector<AddRobot> added;
  std::vector<std::uint64_t> digests;
  for (std::uint32_t i = 0; i < count; ++i) {
    added.push_back(readAddition(in));
    requireContents(names.insert(added.back().name).second, "an added robot has the name of another");
    digests.push_back(in.takeNumber<std::uint64_t>());
  }
  const auto grown = withAdditions(model, RobotAdditions(std::move(added)));
  const auto* robot = grown->fleet.robots.data() + (grown->fleet.robots.size() - count);
  for (const std::uint64_t digest : digests) {
    if (digestOf(*robot) != digest) {
      throw ConfigError("the robot type " + robot->info.type->model +
                        " is not that of the run that saved the state; use its " + "robot types");
    }
    ++robot;
  }
  return grown;
}

State readContents(const Model& start, StateReader in) {
  const auto grown = readAdditions(start, in);
  const Model& model = *grown;
  State state = initialState(model);
  const std::size_t robots = model.fleet.robots.size();
  state.time.step = in.takeNumber<std::uint64_t>();
  state.seed = in.takeNumber<std::uint64_t>();
  readInterventions(in, state);
  readGrippers(in, robots, state);
  state.stalls = in.takeNumber<std::uint64_t>();
  state.messages_delivered = in.takeNumber<std::uint64_t>();
  state.messages_dropped = in.takeNumber<std::uint64_t>();
  readMessages(model, in, state);
  readOutcome(model, in, state);
  for (std::size_t i = 0; i < robots; ++i) readRobot(model, i, in, state);
  if (state.won) {
    for (auto& readings : state.readings) readings.winner = model.fleet.robots[state.won->robot].info.name;
  }
  if (in.isAtEnd()) {
    state.digest.reset();
    return state;
  }
  requireContents(state.digest->load(in.takeBytes(state.digest->savedBytes())), "the run's digest is invalid");
  requireContents(in.isAtEnd(), "they are too long");
  return state;
}

}  // namespace

std::string toBytes(const Model& model, const State& state) {
  StateWriter out;
  out.addBytes(kMagic.data(), kMagic.size());
  out.addNumber(kVersion);
  out.addNumber(std::uint64_t{0});  // the size, known at the end
  out.addNumber(digestOfStart(model));
  writeAdditions(model, out);
  out.addNumber(state.time.step);
  out.addNumber(state.seed);
  writeInterventions(state, out);
  writeGrippers(state, out);
  out.addNumber(state.stalls);
  out.addNumber(state.messages_delivered);
  out.addNumber(state.messages_dropped);
  writeMessages(state, out);
  writeOutcome(state, out);
  for (std::size_t i = 0; i < state.readings.size(); ++i) writeRobot(state, i, out);
  if (state.digest) state.digest->save(out.bytes);
  const std::uint64_t size = out.bytes.size() + kChecksumBytes;
  std::memcpy(out.bytes.data() + kSizeAt, &size, sizeof size);
  out.addNumber(computeChecksum(out.bytes));
  return std::move(out.bytes);
}

State stateFromBytes(const Model& model, std::string_view bytes) {
  if (bytes.substr(0, kMagic.size()) != kMagic.substr(0, bytes.size())) {
    throw ConfigError("this is no saved state of RoboSim; its first bytes differ; give a state that RoboSim has saved");
  }
  const std::uint64_t size =
      bytes.size() < kHeaderBytes ? kHeaderBytes + kChecksumBytes : numberAt<std::uint64_t>(bytes, kSizeAt);
  if (bytes.size() < kHeaderBytes + kChecksumBytes || bytes.size() != size) {
    throw ConfigError("the saved state is incomplete or damaged: it has " + std::to_string(bytes.size()) +
                      " bytes in place of " + std::to_string(size) + "; copy it again, or save the state again");
  }
  const std::string_view checked = bytes.substr(0, bytes.size() - kChecksumBytes);
  if (numberAt<std::uint64_t>(bytes, checked.size()) != computeChecksum(checked)) {
    throw ConfigError("the saved state is damaged: its checksum differs; copy it again, or save the state again");
  }
  if (const auto version = numberAt<std::uint32_t>(bytes, kMagic.size()); version != kVersion) {
    throw ConfigError("the saved state has version " + std::to_string(version) + " of the format, and this program " +
                      "reads version " + std::to_string(kVersion) + "; use the version of RoboSim that saved it");
  }
  if (numberAt<std::uint64_t>(bytes, kSizeAt + sizeof size) != digestOfStart(model)) {
    throw ConfigError(
        "the saved state belongs to another world, other robots or sensors, or another seed or time step; "
        "load it with those of the run that saved it");
  }
  try {
    return readContents(model, StateReader(checked.substr(kHeaderBytes)));
  } catch (const InvalidContents& fault) {
    throw ConfigError(std::string("the contents of a saved state are invalid: ") + fault.what() +
                      "; save the state again");
  }
}

}  // namespace robosim
