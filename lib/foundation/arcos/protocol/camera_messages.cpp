#include "arcos/protocol/camera_messages.h"

namespace robosim::arcos {
namespace {

constexpr std::size_t kLongestMessage = 32;

bool beginsVisca(char byte) {
  const auto number = static_cast<std::uint8_t>(byte);
  return number >= 0x81 && number <= 0x88;
}

}  // namespace

std::optional<std::string> CameraMessageReader::next() {
  while (!buffer_.empty()) {
    const bool is_visca = beginsVisca(buffer_[0]);
    if (!is_visca && buffer_[0] != vcc4::kFirst) {
      buffer_.erase(0, 1);
      continue;
    }
    const std::size_t last = buffer_.find(is_visca ? visca::kLast : vcc4::kLast, 1);
    // No VC-C4 message contains its first byte: one that does was cut, and the next begins there.
    const std::size_t again = is_visca ? std::string::npos : buffer_.find(vcc4::kFirst, 1);
    if (again < last) {
      buffer_.erase(0, again);
      continue;
    }
    if (last != std::string::npos && last < kLongestMessage) {
      std::string message = buffer_.substr(0, last + 1);
      buffer_.erase(0, last + 1);
      return message;
    }
    if (last == std::string::npos && buffer_.size() < kLongestMessage) return std::nullopt;
    buffer_.erase(0, 1);
  }
  return std::nullopt;
}

namespace vcc4 {
namespace {

/// The camera's number, which is 00 unless its switches are set otherwise.
constexpr std::string_view kNumber = "00";

}  // namespace

std::string hexadecimal(int number, int digits) {
  std::string text(static_cast<std::size_t>(digits), '0');
  for (std::size_t i = text.size(); i-- > 0; number /= 16) text[i] = "0123456789ABCDEF"[number % 16];
  return text;
}

std::optional<int> numberOf(std::string_view digits) {
  if (digits.empty() || digits.size() > 7) return std::nullopt;
  int number = 0;
  for (const char digit : digits) {
    const bool is_decimal = digit >= '0' && digit <= '9';
    if (!is_decimal && !(digit >= 'A' && digit <= 'F')) return std::nullopt;
    number = 16 * number + (is_decimal ? digit - '0' : digit - 'A' + 10);
  }
  return number;
}

std::string encode(const Command& command) {
  std::string message{kFirst};
  message += kNumber;
  message += '\0';
  message += static_cast<char>(command.id);
  return message + command.parameters + kLast;
}

std::optional<Command> decode(std::string_view message) {
  constexpr std::size_t kBefore = 4;  // first byte, number, 00
  if (message.size() < kBefore + 2 || message[0] != kFirst || message[kBefore - 1] != '\0' || message.back() != kLast) {
    return std::nullopt;
  }
  return Command{static_cast<std::uint8_t>(message[kBefore]),
                 std::string(message.substr(kBefore + 1, message.size() - kBefore - 2))};
}

std::string encodeAnswer(Error error, const std::string& digits) {
  std::string message{kFirstOfAnswer};
  message += kNumber;
  message += static_cast<char>(error);
  return message + '0' + digits + kLast;
}

}  // namespace vcc4

namespace visca {
namespace {

using namespace std::string_view_literals;

constexpr char kToCamera = '\x81', kToAll = '\x88', kFromCamera = '\x90';
// What follows the first byte. Speeds are between the beginning of a turn and its numbers.
constexpr auto kTurnTo = "\x01\x06\x02"sv, kTurnHome = "\x01\x06\x04\xFF"sv, kTurnStop = "\x01\x06\x01"sv,
               kZoomTo = "\x01\x04\x47"sv, kZoomStop = "\x01\x04\x07\x00\xFF"sv,
               kDirectionRequest = "\x09\x06\x12\xFF"sv, kZoomRequest = "\x09\x04\x47\xFF"sv;
constexpr auto kFastest = "\x18\x14"sv, kStopBoth = "\x03\x03"sv;
constexpr auto kReceived = "\x90\x41\xFF"sv, kCarriedOut = "\x90\x51\xFF"sv;

std::string quarters(int number) {
  const auto bits = static_cast<unsigned>(number);
  std::string bytes;
  for (const int shift : {12, 8, 4, 0}) bytes += static_cast<char>(bits >> shift & 0xFu);
  return bytes;
}

/// A signed number of 16 bits.
int numberAt(std::string_view bytes, std::size_t at) {
  unsigned number = 0;
  for (std::size_t i = 0; i < 4; ++i) number = number << 4 | (static_cast<unsigned>(bytes[at + i]) & 0xFu);
  return static_cast<std::int16_t>(static_cast<std::uint16_t>(number));
}

}  // namespace

std::string encodeTurn(int pan, int tilt) {
  return kToCamera + std::string(kTurnTo) + std::string(kFastest) + quarters(pan) + quarters(tilt) + kLast;
}

std::string encodeZoom(int zoom) { return kToCamera + std::string(kZoomTo) + quarters(zoom) + kLast; }

std::optional<Command> decode(std::string_view message) {
  const bool is_for_this = message.size() >= 3 && (message[0] == kToCamera || message[0] == kToAll);
  if (!is_for_this || message.back() != kLast) return std::nullopt;
  const std::string_view rest = message.substr(1);
  Command command;
  if (rest.starts_with(kTurnTo) && rest.size() == kTurnTo.size() + 2 + 8 + 1) {
    command = {Kind::turn_to, numberAt(rest, kTurnTo.size() + 2), numberAt(rest, kTurnTo.size() + 6)};
  } else if (rest.starts_with(kZoomTo) && rest.size() == kZoomTo.size() + 4 + 1) {
    command = {Kind::zoom_to, 0, 0, numberAt(rest, kZoomTo.size())};
  } else if (rest == kTurnHome) {
    command.kind = Kind::turn_home;
  } else if (rest.starts_with(kTurnStop) && rest.size() == kTurnStop.size() + 5 && rest.substr(5, 2) == kStopBoth) {
    command.kind = Kind::turn_stop;
  } else if (rest == kZoomStop) {
    command.kind = Kind::zoom_stop;
  } else if (rest == kDirectionRequest) {
    command.kind = Kind::direction_request;
  } else if (rest == kZoomRequest) {
    command.kind = Kind::zoom_request;
  }
  return command;
}

std::string encodeDone() { return std::string(kReceived) + std::string(kCarriedOut); }

std::string encodeDirection(int pan, int tilt) {
  return kFromCamera + ("\x50" + quarters(pan) + quarters(tilt)) + kLast;
}

std::string encodeZoomPosition(int zoom) { return kFromCamera + ("\x50" + quarters(zoom)) + kLast; }

}  // namespace visca
}  // namespace robosim::arcos
