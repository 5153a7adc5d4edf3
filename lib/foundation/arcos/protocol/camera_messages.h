#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

/// @file
/// Messages between programs and the cameras of Pioneers that pan, tilt and zoom, over a serial port: those of the
/// Canon VC-C4, and VISCA of the Sony EVI-D30. Pan is counted to the right, tilt up.
namespace robosim::arcos {

/// Finds the messages of a program in a stream of bytes. After bytes that are no message it continues at the next
/// first byte of one.
class CameraMessageReader {
 public:
  void add(std::string_view bytes) { buffer_ += bytes; }
  /// The next complete message, from its first byte to its last; nullopt until there are more bytes.
  std::optional<std::string> next();

 private:
  std::string buffer_;
};

/// Messages of the VC-C4: FF, the camera's number as two digits, 00, a command, its parameters as digits ('0' to '?' or
/// hexadecimal), EF. Answers: FE, the number, an error, '0', digits, EF.
namespace vcc4 {

constexpr char kFirst = '\xFF', kLast = '\xEF', kFirstOfAnswer = '\xFE';

/// Commands of ARIA's ArVCC4 that have an effect.
namespace command {
constexpr std::uint8_t pan_speed = 0x50, tilt_speed = 0x51;  ///< 3 digits, in units per second
constexpr std::uint8_t stop = 0x53;                          ///< pan and tilt
constexpr std::uint8_t init = 0x58;                          ///< pan and tilt to 0
constexpr std::uint8_t turn_to = 0x62;                       ///< 4 digits each: pan, tilt, in units from kZero on
constexpr std::uint8_t direction_request = 0x63;
constexpr std::uint8_t control = 0x90;  ///< '0': the program controls the camera
constexpr std::uint8_t power = 0xA0;    ///< '0' off, '1' on
constexpr std::uint8_t zoom_stop = 0xA2;
constexpr std::uint8_t zoom_to = 0xB3;       ///< 4 digits: [0, kZoomMax]
constexpr std::uint8_t zoom_request = 0xB4;  ///< '0': its position, '1': the largest one
}  // namespace command

constexpr double kUnit_deg = 0.1125;
constexpr int kZero = 0x8000;
constexpr int kZoomMax = 1960;  ///< the longest focal length

enum class Error : char { none = '0', parameter = '5', mode = '9' };

struct Command {
  std::uint8_t id = 0;
  std::string parameters;
  bool operator==(const Command&) const = default;
};

/// @param digits at least as many as the number has
std::string hexadecimal(int number, int digits);
/// The number of hexadecimal digits; nullopt for other characters, and for none.
std::optional<int> numberOf(std::string_view digits);

std::string encode(const Command& command);
/// The command of a message; nullopt if it is none.
std::optional<Command> decode(std::string_view message);
std::string encodeAnswer(Error error, const std::string& digits = {});

}  // namespace vcc4

/// VISCA: 81 (or 88 for all cameras), bytes, FF. A number is four bytes of 4 bits each.
namespace visca {

constexpr char kLast = '\xFF';
/// Angles of the EVI-D30: ±100° and ±25°.
constexpr double kPanUnit_deg = 100.0 / 880, kTiltUnit_deg = 25.0 / 300;
constexpr int kZoomMax = 1023;

enum class Kind : std::uint8_t {
  turn_to,
  turn_home,
  zoom_to,
  zoom_stop,
  turn_stop,
  direction_request,
  zoom_request,
  other
};

struct Command {
  Kind kind = Kind::other;
  int pan = 0, tilt = 0, zoom = 0;  ///< in units
  bool operator==(const Command&) const = default;
};

std::string encodeTurn(int pan, int tilt);
std::string encodeZoom(int zoom);
/// The command of a message; nullopt if it is none.
std::optional<Command> decode(std::string_view message);
/// That a command was received and carried out.
std::string encodeDone();
std::string encodeDirection(int pan, int tilt);
std::string encodeZoomPosition(int zoom);

}  // namespace visca
}  // namespace robosim::arcos
