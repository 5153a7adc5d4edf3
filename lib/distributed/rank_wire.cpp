#include "distributed/rank_wire.h"

#include <stdexcept>
#include <utility>

#include "environment/measurement_bytes.h"

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

 private:
  StateWriter& out_;
  std::size_t count_at_;
  std::uint32_t count_ = 0;
};

/// Appends what `write` writes.
template <typename Write>
void append(std::string& out, const Write& write) {
  StateWriter writer;
  writer.bytes = std::move(out);
  write(writer);
  out = std::move(writer.bytes);
}

/// Calls read(reader), for bytes of which it must leave nothing.
template <typename Read>
void readAll(std::string_view bytes, const char* what, const Read& read) {
  try {
    StateReader in(bytes);
    read(in);
    requireContents(in.isAtEnd(), "they are too long");
  } catch (const ConfigError& error) {
    throw std::runtime_error("another rank has sent invalid " + std::string(what) + " (" + error.what() +
                             "); use the same version of RoboSim on all machines");
  }
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

}  // namespace

void OrdersWriter::begin(const StepOrders& orders, RobotRange robots) {
  const auto begin = static_cast<std::ptrdiff_t>(robots.begin), end = static_cast<std::ptrdiff_t>(robots.end);
  commands_.assign(orders.commands.begin() + begin, orders.commands.begin() + end);
  win_requests_.assign(orders.win_requests.begin() + begin, orders.win_requests.begin() + end);
  sent_.clear();
  for (std::size_t i = robots.begin; i < robots.end; ++i)
    sent_.push_back({orders.outboxes[i].messages.size(), orders.outboxes[i].surplus});
}

void OrdersWriter::write(const StepOrders& orders, RobotRange robots, std::string& out) {
  append(out, [&](StateWriter& writer) {
    {
      CountedWriter items(writer);
      for (std::size_t i = robots.begin; i < robots.end; ++i) {
        const Command& command = orders.commands[i];
        if (command == commands_[i - robots.begin]) continue;
        items.beginItem(i);
        writer.addNumber(command.speed_mps);
        writer.addNumber(command.turn_radps);
        writer.addNumber(command.laser_pan_rad);
        writer.addNumber(static_cast<std::uint8_t>(command.activity));
        writer.addNumber(std::uint8_t{command.by_driver});
      }
    }
    {
      CountedWriter items(writer);
      for (std::size_t i = robots.begin; i < robots.end; ++i) {
        const Outbox& outbox = orders.outboxes[i];
        const Sent& before = sent_[i - robots.begin];
        if (outbox.messages.size() == before.messages && outbox.surplus == before.surplus) continue;
        items.beginItem(i);
        writer.addNumber(outbox.surplus);
        writer.addNumber(static_cast<std::uint32_t>(outbox.messages.size() - before.messages));
        for (std::size_t k = before.messages; k < outbox.messages.size(); ++k) {
          writer.addNumber(outbox.messages[k].to);
          writer.addText(outbox.messages[k].text);
        }
      }
    }
    CountedWriter items(writer);
    for (std::size_t i = robots.begin; i < robots.end; ++i) {
      if (orders.win_requests[i] != win_requests_[i - robots.begin]) items.beginItem(i);
    }
  });
}

void readOrders(std::string_view bytes, RobotRange from, const StepOrders& orders) {
  readAll(bytes, "commands", [&](StateReader& in) {
    forItems(in, from, [&](std::size_t i) {
      Command& command = orders.commands[i];
      command.speed_mps = in.takeFinite();
      command.turn_radps = in.takeFinite();
      command.laser_pan_rad = in.takeNumber<float>();
      command.activity = in.takeActivity();
      command.by_driver = in.takeFlag();
    });
    forItems(in, from, [&](std::size_t i) {
      Outbox& outbox = orders.outboxes[i];
      outbox.surplus = in.takeNumber<std::uint64_t>();
      for (auto left = in.takeNumber<std::uint32_t>(); left > 0; --left) {
        PendingMessage& message = outbox.messages.emplace_back();
        message.to = in.takeNumber<std::uint32_t>();
        requireContents(message.to < orders.outboxes.size(), "a message has an unknown receiver");
        message.text = in.takeText(kMaxMessageBytes);
      }
    });
    forItems(in, from, [&](std::size_t i) { orders.win_requests[i] = 1; });
  });
}

void writePaths(const PhaseResults& results, RobotRange robots, std::string& out) {
  append(out, [&](StateWriter& writer) {
    CountedWriter items(writer);
    for (std::size_t i = robots.begin; i < robots.end; ++i) {
      if (results.paths[i].end_fraction == 1) continue;
      items.beginItem(i);
      writer.addNumber(results.paths[i].end_fraction);
    }
  });
}

void readPaths(std::string_view bytes, RobotRange from, const PhaseResults& results) {
  readAll(bytes, "paths", [&](StateReader& in) {
    forItems(in, from, [&](std::size_t i) { results.paths[i].end_fraction = in.takeFinite(); });
  });
}

void writeStays(const PhaseResults& results, RobotRange robots, std::string& out) {
  append(out, [&](StateWriter& writer) {
    CountedWriter items(writer);
    for (std::size_t i = robots.begin; i < robots.end; ++i) {
      if (results.stays[i]) items.beginItem(i);
    }
  });
}

void readStays(std::string_view bytes, RobotRange from, const PhaseResults& results) {
  readAll(bytes, "robots that stay",
          [&](StateReader& in) { forItems(in, from, [&](std::size_t i) { results.stays[i] = 1; }); });
}

void writeReadings(const PhaseResults& results, RobotRange robots, std::string& out) {
  append(out, [&](StateWriter& writer) {
    for (std::size_t i = robots.begin; i < robots.end; ++i) writeMeasurements(results.readings[i], writer);
  });
}

void readReadings(std::string_view bytes, RobotRange robots, const PhaseResults& results) {
  readAll(bytes, "readings", [&](StateReader& in) {
    for (std::size_t i = robots.begin; i < robots.end; ++i) readMeasurements(in, results.readings[i]);
  });
}

}  // namespace robosim
