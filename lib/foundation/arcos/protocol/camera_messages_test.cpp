#include "arcos/protocol/camera_messages.h"

#include <gtest/gtest.h>

#include "arcos/protocol/aux_port.h"
#include "arcos/protocol/command.h"
#include "arcos/protocol/packet.h"
#include "arcos/protocol/testing/hex.h"

namespace robosim::arcos {
namespace {

// The messages that ARIA's ArVCC4 sends, by its public source.
TEST(Vcc4Messages, HaveTheBytesOfArvcc4) {
  using namespace vcc4;
  namespace camera = vcc4::command;
  const auto bytes = [](std::uint8_t id, const std::string& parameters) {
    return hex(vcc4::encode(Command{id, parameters}));
  };
  EXPECT_EQ(bytes(camera::power, "1"), "ff 30 30 00 a0 31 ef");
  EXPECT_EQ(bytes(camera::control, "0"), "ff 30 30 00 90 30 ef");
  EXPECT_EQ(bytes(camera::init, "0"), "ff 30 30 00 58 30 ef");
  EXPECT_EQ(bytes(camera::pan_speed, "320"), "ff 30 30 00 50 33 32 30 ef") << "90 °/s are 800 units per second";
  EXPECT_EQ(bytes(camera::stop, "0"), "ff 30 30 00 53 30 ef");
  // 45° to the right and 10° down: 400 and -89 units from 0x8000.
  EXPECT_EQ(bytes(camera::turn_to, hexadecimal(kZero + 400, 4) + hexadecimal(kZero - 89, 4)),
            "ff 30 30 00 62 38 31 39 30 37 46 41 37 ef");
  EXPECT_EQ(bytes(camera::zoom_to, hexadecimal(980, 4)), "ff 30 30 00 b3 30 33 44 34 ef");
  EXPECT_EQ(bytes(camera::direction_request, ""), "ff 30 30 00 63 ef");
  EXPECT_EQ(bytes(camera::zoom_request, "0"), "ff 30 30 00 b4 30 ef");
  EXPECT_EQ(hex(vcc4::encodeAnswer(Error::none)), "fe 30 30 30 30 ef");
  EXPECT_EQ(hex(vcc4::encodeAnswer(Error::mode)), "fe 30 30 39 30 ef");
  EXPECT_EQ(hex(vcc4::encodeAnswer(Error::none, "81907FA7")), "fe 30 30 30 30 38 31 39 30 37 46 41 37 ef");
}

TEST(Vcc4Messages, AreReadAsTheyAreWritten) {
  using namespace vcc4;
  namespace camera = vcc4::command;
  const Command turn{camera::turn_to, "81907FA7"};
  EXPECT_EQ(decode(vcc4::encode(turn)), turn);
  EXPECT_EQ(vcc4::numberOf("81907"), 0x81907);
  EXPECT_EQ(vcc4::numberOf("7FA7"), kZero - 89);
  EXPECT_EQ(vcc4::numberOf(""), std::nullopt);
  EXPECT_EQ(vcc4::numberOf("7fa7"), std::nullopt);
  EXPECT_EQ(decode(fromHex("ff 30 30 01 58 30 ef")), std::nullopt);
  EXPECT_EQ(decode(fromHex("ff 30 30 00 ef")), std::nullopt);
}

// The messages of ARIA's ArSonyPTZ, by its public source: pan 440 units to the right, tilt 120 down; zoom 512.
TEST(ViscaMessages, HaveTheBytesOfArsonyptz) {
  using namespace visca;
  EXPECT_EQ(hex(encodeTurn(440, -120)), "81 01 06 02 18 14 00 01 0b 08 0f 0f 08 08 ff");
  EXPECT_EQ(hex(encodeZoom(512)), "81 01 04 47 00 02 00 00 ff");
  EXPECT_EQ(decode(encodeTurn(440, -120)), (Command{Kind::turn_to, 440, -120}));
  EXPECT_EQ(decode(encodeZoom(512)), (Command{Kind::zoom_to, 0, 0, 512}));
  EXPECT_EQ(decode(fromHex("81 09 06 12 ff")), Command{Kind::direction_request});
  EXPECT_EQ(decode(fromHex("81 09 04 47 ff")), Command{Kind::zoom_request});
  EXPECT_EQ(decode(fromHex("81 01 06 04 ff")), Command{Kind::turn_home});
  EXPECT_EQ(decode(fromHex("81 01 06 01 18 14 03 03 ff")), Command{Kind::turn_stop});
  EXPECT_EQ(decode(fromHex("81 01 04 07 00 ff")), Command{Kind::zoom_stop});
  EXPECT_EQ(decode(fromHex("88 01 00 01 ff")), Command{Kind::other});
  EXPECT_EQ(decode(fromHex("81 01 06 02 18 14 00 ff")), Command{Kind::other}) << "too short";
  EXPECT_EQ(decode(fromHex("ff 30 30 00 58 30 ef")), std::nullopt);
  EXPECT_EQ(decode(fromHex("82 01 06 04 ff")), std::nullopt) << "of the second camera of a chain";
  EXPECT_EQ(hex(encodeDone()), "90 41 ff 90 51 ff");
  EXPECT_EQ(hex(encodeDirection(440, -120)), "90 50 00 01 0b 08 0f 0f 08 08 ff");
  EXPECT_EQ(hex(encodeZoomPosition(512)), "90 50 00 02 00 00 ff");
}

TEST(CameraMessageReader, FindsMessagesOfBothCamerasInPiecesAndAmongOtherBytes) {
  CameraMessageReader reader;
  const std::string canon = fromHex("ff 30 30 00 58 30 ef"), sony = fromHex("81 09 06 12 ff");
  reader.add("ab" + canon.substr(0, 3));
  EXPECT_EQ(reader.next(), std::nullopt);
  reader.add(canon.substr(3) + sony + "\x7F");
  EXPECT_EQ(reader.next(), canon);
  EXPECT_EQ(reader.next(), sony);
  EXPECT_EQ(reader.next(), std::nullopt);
  reader.add("\xFF" + std::string(100, '0'));
  EXPECT_EQ(reader.next(), std::nullopt) << "too long for a message";
  reader.add(canon);
  EXPECT_EQ(reader.next(), canon);
  reader.add(fromHex("ff 30 30 00 a0") + canon);
  EXPECT_EQ(reader.next(), canon) << "after one that was cut";
}

TEST(AuxPort, SendsAPacketWhenAllRequestedBytesAreThere) {
  AuxPort port;
  port.request(6);
  EXPECT_EQ(port.takePacket(), "");
  port.receive(fromHex("fe 30 30"));
  EXPECT_EQ(port.takePacket(), "");
  port.receive(fromHex("30 30 ef fe"));
  // The sum of b0fe, 3030 and 3030 modulo 2^16 is 115e; with ef by XOR, 11b1.
  EXPECT_EQ(hex(port.takePacket()), "fa fb 09 b0 fe 30 30 30 30 ef 11 b1");
  EXPECT_EQ(port.takePacket(), "") << "once";
  port.request(1);
  EXPECT_EQ(port.takePacket().size(), 7u) << "the byte that was kept";
}

TEST(AuxPort, DiscardsBytesAndLimitsThem) {
  AuxPort port;
  port.receive("abcdef");
  port.request(3);
  port.request(0);
  EXPECT_EQ(port.takePacket(), "");
  port.request(2);
  port.request(1000);
  port.request(-1);
  port.receive("xyz");
  EXPECT_EQ(port.takePacket(), encode(packet_type::aux, "xy"));
  port.receive(std::string(5000, 'z'));
  for (std::size_t left = AuxPort::kKeptMax / 128; left > 0; --left) {
    port.request(128);
    EXPECT_EQ(port.takePacket(), encode(packet_type::aux, std::string(128, 'z')));
  }
  port.request(1);
  EXPECT_EQ(port.takePacket(), "");
}

}  // namespace
}  // namespace robosim::arcos
