#include "distributed/rank_wire.h"

#include <array>
#include <bit>
#include <utility>

#include "distributed/rank_bytes.h"
#include "environment/command_bytes.h"
#include "environment/measurement_bytes.h"
#include "environment/step_phases.h"

namespace robosim {
namespace {

/// Writes items behind their number.
class CountedWriter {
 public:
  CountedWriter(StateWriter& out) : out_(out), count_at_(out.bytes.size()) { out_.addNumber(std::uint32_t{0}); }
  ~CountedWriter() { std::memcpy(out_.bytes.data() + count_at_, &count_, sizeof count_); }
  CountedWriter(const CountedWriter&) = delete;
  CountedWriter& operator=(const CountedWriter&) = delete;
  void beginItem(std::size_t robot) {
    ++count_;
    out_.addNumber(static_cast<std::uint32_t>(robot));
  }
  bool isEmpty() const { return count_ == 0; }

 private:
  StateWriter& out_;
  std::size_t count_at_;
  std::uint32_t count_ = 0;
};

/// Appends what `write` writes, if it returns true.
template <typename Write>
void append(std::string& out, const Write& write) {
  const std::size_t before = out.size();
  StateWriter writer;
  writer.bytes = std::move(out);
  const bool is_needed = write(writer);
  out = std::move(writer.bytes);
  if (!is_needed) out.resize(before);
}

/// Appends the items that write(items) writes, if there is any. @return whether there is
template <typename Write>
bool addItems(StateWriter& writer, const Write& write) {
  CountedWriter items(writer);
  write(items);
  return !items.isEmpty();
}

/// Calls read(robot) for each item that CountedWriter has written.
template <typename Read>
void forItems(StateReader& in, RobotRange from, const Read& read) {
  for (auto left = in.takeNumber<std::uint32_t>(); left > 0; --left) {
    const auto robot = in.takeNumber<std::uint32_t>();
    requireContents(from.contains(robot), "a robot is of another rank");
    read(std::size_t{robot});
  }
}

/// Unlike ==, distinguishes 0 and -0, as the digest of a run does.
bool haveSameBits(const Command& a, const Command& b) {
  const auto numbers = [](const Command& command) {
    return std::array{std::bit_cast<std::uint64_t>(command.speed_mps),
                      std::bit_cast<std::uint64_t>(command.turn_radps),
                      std::uint64_t{std::bit_cast<std::uint32_t>(command.laser_pan_rad)},
                      std::bit_cast<std::uint64_t>(command.lateral_mps),
                      std::bit_cast<std::uint64_t>(command.camera_head->aim.pan_rad),
                      std::bit_cast<std::uint64_t>(command.camera_head->aim.tilt_rad)};
  };
  return a == b && numbers(a) == numbers(b);
}

const Outbox& outboxOf(const StepOrders& orders, std::size_t robot) {
  static const Outbox kEmpty;
  return orders.outboxes[robot] ? *orders.outboxes[robot] : kEmpty;
}

}  // namespace

void OrdersWriter::begin(const StepOrders& orders, RobotRange robots) {
  robots_ = robots;
  const auto begin = static_cast<std::ptrdiff_t>(robots.begin), end = static_cast<std::ptrdiff_t>(robots.end);
  commands_.assign(orders.commands.begin() + begin, orders.commands.begin() + end);
  win_requests_.assign(orders.win_requests.begin() + begin, orders.win_requests.begin() + end);
  sent_.clear();
  for (std::size_t i = robots.begin; i < robots.end; ++i)
    sent_.push_back({outboxOf(orders, i).messages.size(), outboxOf(orders, i).surplus});
}

bool OrdersWriter::hasChanged(const StepOrders& orders, std::size_t robot) const {
  return !haveSameBits(orders.commands[robot], commands_[robot - robots_.begin]);
}

bool OrdersWriter::addCommands(StateWriter& writer, const StepOrders& orders,
                               std::span<const std::uint32_t> known) const {
  return addItems(writer, [&](CountedWriter& items) {
    for (const std::uint32_t i : known) {
      if (!hasChanged(orders, i)) continue;
      items.beginItem(i);
      writeCommand(orders.commands[i], writer);
    }
  });
}

void OrdersWriter::end(const StepOrders& orders, std::span<const std::uint32_t> known_to_all) {
  for_all_.clear();
  append(for_all_, [&](StateWriter& writer) {
    bool has_changes = addCommands(writer, orders, known_to_all);
    has_changes |= addItems(writer, [&](CountedWriter& items) {
      for (std::size_t i = robots_.begin; i < robots_.end; ++i) {
        if (orders.commands[i].activity == commands_[i - robots_.begin].activity) continue;
        items.beginItem(i);
        writer.addNumber(static_cast<std::uint8_t>(orders.commands[i].activity));
      }
    });
    has_changes |= addItems(writer, [&](CountedWriter& items) {
      for (std::size_t i = robots_.begin; i < robots_.end; ++i) {
        const Outbox& outbox = outboxOf(orders, i);
        const Sent& before = sent_[i - robots_.begin];
        if (outbox.messages.size() == before.messages && outbox.surplus == before.surplus) continue;
        items.beginItem(i);
        writer.addNumber(outbox.surplus);
        writer.addNumber(static_cast<std::uint32_t>(outbox.messages.size() - before.messages));
        for (std::size_t k = before.messages; k < outbox.messages.size(); ++k) {
          writer.addNumber(outbox.messages[k].to);
          writer.addText(outbox.messages[k].text);
        }
      }
    });
    has_changes |= addItems(writer, [&](CountedWriter& items) {
      for (std::size_t i = robots_.begin; i < robots_.end; ++i) {
        if (orders.win_requests[i] != win_requests_[i - robots_.begin]) items.beginItem(i);
      }
    });
    return has_changes;
  });
}

void OrdersWriter::writeCommands(const StepOrders& orders, std::span<const std::uint32_t> known,
                                 std::string& out) const {
  append(out, [&](StateWriter& writer) { return addCommands(writer, orders, known); });
}

void readCommands(std::string_view bytes, RobotRange from, const StepOrders& orders) {
  readRankBytes(bytes, "commands", [&](StateReader& in) {
    forItems(in, from, [&](std::size_t i) { orders.commands[i] = readCommand(in); });
  });
}

void readOrders(std::string_view bytes, RobotRange from, const StepOrders& orders) {
  readRankBytes(bytes, "orders", [&](StateReader& in) {
    forItems(in, from, [&](std::size_t i) { orders.commands[i] = readCommand(in); });
    // Of robots whose commands are not sent.
    forItems(in, from, [&](std::size_t i) {
      const Activity activity = in.takeActivity();
      if (orders.activity[i] == Activity::active && activity != Activity::absent) orders.activity[i] = activity;
    });
    forItems(in, from, [&](std::size_t i) {
      if (!orders.outboxes[i]) orders.outboxes[i].emplace();
      Outbox& outbox = *orders.outboxes[i];
      orders.may_send[i] = 1;
      outbox.surplus = in.takeNumber<std::uint64_t>();
      for (auto left = in.takeNumber<std::uint32_t>(); left > 0; --left) {
        PendingMessage& message = outbox.messages.emplace_back();
        message.to = in.takeNumber<std::uint32_t>();
        requireContents(message.to < orders.outboxes.size() || message.isBroadcast(),
                        "a message has an unknown receiver");
        message.text = in.takeText(kMaxMessageBytes);
      }
    });
    forItems(in, from, [&](std::size_t i) { orders.win_requests[i] = 1; });
  });
}

void writePaths(const PhaseResults& results, std::span<const std::uint32_t> robots, std::string& out) {
  append(out, [&](StateWriter& writer) {
    return addItems(writer, [&](CountedWriter& items) {
      for (const std::uint32_t i : robots) {
        if (results.paths[i].end_fraction == 1) continue;
        items.beginItem(i);
        writer.addNumber(results.paths[i].end_fraction);
      }
    });
  });
}

void readPaths(std::string_view bytes, RobotRange from, const PhaseResults& results) {
  readRankBytes(bytes, "paths", [&](StateReader& in) {
    forItems(in, from, [&](std::size_t i) { results.paths[i].end_fraction = in.takeNumber<double>(); });
  });
}

void writeStays(const PhaseResults& results, std::span<const std::uint32_t> robots, std::string& out) {
  append(out, [&](StateWriter& writer) {
    return addItems(writer, [&](CountedWriter& items) {
      for (const std::uint32_t i : robots) {
        if (results.stays[i]) items.beginItem(i);
      }
    });
  });
}

void readStays(std::string_view bytes, RobotRange from, const PhaseResults& results) {
  readRankBytes(bytes, "robots that stay",
                [&](StateReader& in) { forItems(in, from, [&](std::size_t i) { results.stays[i] = 1; }); });
}

void writeReadings(const PhaseResults& results, RobotRange robots, std::string& out) {
  append(out, [&](StateWriter& writer) {
    for (std::size_t i = robots.begin; i < robots.end; ++i) writeMeasurements(results.readings[i], writer);
    return true;
  });
}

void readReadings(std::string_view bytes, RobotRange robots, const PhaseResults& results) {
  readRankBytes(bytes, "readings", [&](StateReader& in) {
    for (std::size_t i = robots.begin; i < robots.end; ++i)
      readMeasurements(in, results.readings[i], NumberCheck::none);
  });
}

void writeMotion(const MotionState& motion, const StepOrders& orders, std::span<const std::uint32_t> robots,
                 std::string& out) {
  append(out, [&](StateWriter& writer) {
    return addItems(writer, [&](CountedWriter& items) {
      for (const std::uint32_t i : robots) {
        items.beginItem(i);
        writer.addPose(motion.world_from_robot[i]);
        writer.addNumber(motion.speed_mps[i]);
        writer.addNumber(motion.turn_radps[i]);
        writer.addNumber(motion.last_motion[i].length_m);
        writer.addNumber(motion.last_motion[i].turn_rad);
        if (!motion.drives.empty()) {
          writer.addNumber(motion.last_motion[i].lateral_m);
          writer.addNumber(motion.drives[i].lateral_mps);
          writer.addNumber(motion.drives[i].steering_rad);
        }
        writer.addNumber(motion.driven_m[i]);
        writer.addNumber(motion.stalled[i]);
        writer.addNumber(motion.laser_pan_rad[i]);
        writeCommand(orders.commands[i], writer);
      }
    });
  });
}

void readMotion(std::string_view bytes, RobotRange from, const MotionState& motion, const StepOrders& orders,
                std::vector<std::uint32_t>& read) {
  readRankBytes(bytes, "states of robots", [&](StateReader& in) {
    forItems(in, from, [&](std::size_t i) {
      auto& pose = motion.world_from_robot[i];
      for (double* value : {&pose.x, &pose.y, &pose.phi}) *value = in.takeNumber<double>();
      motion.speed_mps[i] = in.takeNumber<double>();
      motion.turn_radps[i] = in.takeNumber<double>();
      motion.last_motion[i].length_m = in.takeNumber<double>();
      motion.last_motion[i].turn_rad = in.takeNumber<double>();
      if (!motion.drives.empty()) {
        motion.last_motion[i].lateral_m = in.takeNumber<double>();
        motion.drives[i].lateral_mps = in.takeNumber<double>();
        motion.drives[i].steering_rad = in.takeNumber<double>();
      }
      motion.driven_m[i] = in.takeNumber<double>();
      motion.stalled[i] = in.takeFlag() ? 1 : 0;
      motion.laser_pan_rad[i] = in.takeNumber<float>();
      orders.commands[i] = readCommand(in);
      requireContents(read.empty() || read.back() < i, "the robots are not in ascending order");
      read.push_back(static_cast<std::uint32_t>(i));
    });
  });
}

}  // namespace robosim
