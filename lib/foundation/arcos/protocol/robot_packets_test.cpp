#include <cmath>

#include <gtest/gtest.h>

#include "arcos/protocol/bytes.h"
#include "arcos/protocol/command.h"
#include "arcos/protocol/config_packet.h"
#include "arcos/protocol/gyro_packet.h"
#include "arcos/protocol/io_packets.h"
#include "arcos/protocol/laser_packets.h"
#include "arcos/protocol/simulator_packets.h"
#include "arcos/protocol/sip.h"
#include "arcos/protocol/testing/hex.h"

namespace robosim::arcos {
namespace {

Packet packetOf(const std::string& bytes) {
  PacketReader reader;
  reader.add(bytes);
  const auto packet = reader.next();
  EXPECT_TRUE(packet && reader.pendingBytes() == 0) << hex(bytes);
  return packet.value_or(Packet{});
}

// A standing robot with 16 sonars, motors on, 13.0 V, temperature -127, as seen on the wire.
constexpr const char* kSip = "fa fb 56 32 00 00 00 00 00 00 00 00 00 00 82 00 00 00 00 1f 00 00 10";
constexpr const char* kSipEnd = "00 00 00 ff ff 82 00 00 00 00 00 00 00 00 81 00";

Sip standing() {
  Sip sip;
  sip.battery = 130;
  sip.battery_decivolts = 130;
  sip.flags = Sip::kMotorsOn | Sip::kSonarOn;
  sip.temperature = -127;
  for (std::uint8_t i = 0; i < 16; ++i) sip.sonars.push_back({i, static_cast<std::uint16_t>(100 * i + 1)});
  return sip;
}

TEST(ArcosSip, HasTheBytesOfAKnownSip) {
  const std::string bytes = encode(standing());
  EXPECT_EQ(bytes.size(), 89u);
  EXPECT_EQ(hex(bytes.substr(0, 23)), kSip);
  EXPECT_EQ(hex(bytes.substr(23, 6)), "00 01 00 01 65 00");
  EXPECT_EQ(hex(bytes.substr(23 + 48, 16)), kSipEnd);
}

TEST(ArcosSip, IsReadAsItWasWritten) {
  Sip sip = standing();
  sip.is_moving = true;
  sip.x = 65'000;
  sip.y = 1;
  sip.heading = -2048;
  sip.speed_left = -300;
  sip.speed_right = 450;
  sip.stall_left = 0x03;
  sip.stall_right = 0x21;
  sip.compass = 179;
  sip.turn_rate = -325;
  sip.charge_percent = 77;
  EXPECT_EQ(decodeSip(packetOf(encode(sip))), sip);
}

TEST(ArcosSip, MayEndAfterTheSonarsOrAnyLaterField) {
  const Packet whole = packetOf(encode(standing()));
  const std::size_t sonars_end = 19 + 3 * 16;
  for (std::size_t size = 0; size <= whole.payload.size(); ++size) {
    const auto sip = decodeSip({whole.id, whole.payload.substr(0, size)});
    EXPECT_EQ(sip.has_value(), size >= sonars_end) << size;
    EXPECT_TRUE(!sip || sip->sonars == standing().sonars);
  }
}

TEST(ArcosConfig, IsReadAsItWasWrittenAndFitsAPacket) {
  ConfigPacket config;
  config.subclass = "p3dx";
  config.name = "Pioneer1";
  config.turn_top = 500;
  config.speed_top = 2200;
  config.turn_accel_top = 600;
  config.accel_top = 2000;
  config.has_front_sonar = config.has_rear_sonar = true;
  config.low_battery_decivolts = 115;
  config.watchdog_ms = 2000;
  config.turn_max = 100;
  config.speed_max = 1000;
  config.turn_accel = config.turn_decel = 101;
  config.accel = 301;
  config.decel = 302;
  config.front_bumpers = 5;
  config.rear_bumpers = 4;
  config.ticks_per_mm = 128;
  const std::string bytes = encode(config);
  EXPECT_LE(bytes.size(), 203u);
  EXPECT_EQ(decodeConfig(packetOf(bytes)), config);
}

// The order of fields of a p3dx, whose packet has 124 bytes with ten characters of name and firmware.
TEST(ArcosConfig, HasItsFieldsInTheOrderOfTheSpecification) {
  ConfigPacket config;
  config.subclass = "p3dx";
  config.name = "P3DX1";
  config.turn_top = 500;
  config.speed_top = 2200;
  config.turn_accel_top = 600;
  config.accel_top = 2000;
  config.has_front_sonar = config.has_rear_sonar = true;
  config.low_battery_decivolts = 115;
  config.watchdog_ms = 2000;
  config.turn_max = 100;
  config.speed_max = 1000;
  config.turn_accel = 100;
  config.turn_decel = 101;
  config.accel = 300;
  config.decel = 301;
  config.front_bumpers = config.rear_bumpers = 5;
  config.ticks_per_mm = 128;
  config.firmware = "S.1.0";
  EXPECT_EQ(hex(encode(config)),
            "fa fb 79 20 50 69 6f 6e 65 65 72 00 70 33 64 78 00 53 49 4d 00 00 f4 01 98 08 58 02 d0 07 90 01 "
            "50 33 44 58 31 00 64 00 00 00 00 01 00 01 73 00 ba 40 d0 07 00 00 00 00 00 00 00 00 00 64 00 e8 "
            "03 64 00 65 00 00 00 00 00 00 00 2c 01 2d 01 00 00 00 00 00 00 05 05 00 28 00 00 00 00 00 00 80 "
            "00 00 00 53 2e 31 2e 30 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 3e ab");
}

TEST(ArcosGyro, SendsFourReadingsOfItsVoltage) {
  EXPECT_EQ(hex(encodeGyro(0)), hex(encode(0x98, std::string("\x04\0\x02\x19\0\x02\x19\0\x02\x19\0\x02\x19", 13))))
      << "512, half of the range";
  // 90°/s are 0.75 V, 153.45 counts, by 1.626: 94.373 counts less. The sum of four is 1,670.5.
  PacketReader reader;
  reader.add(encodeGyro(M_PI / 2));
  const auto packet = reader.next();
  ASSERT_TRUE(packet);
  ByteReader bytes(packet->payload);
  EXPECT_EQ(bytes.take<std::uint8_t>(), 4);
  int sum = 0;
  for (int i = 0; i < 4; ++i) {
    const int reading = bytes.take<std::uint16_t>();
    bytes.take<std::uint8_t>();
    EXPECT_NEAR(reading, 417.627, 1);
    sum += reading;
  }
  EXPECT_EQ(sum, 1671);
}

TEST(ArcosSimulator, HasTheFieldsOfItsStateInTheOrderOfTheSpecification) {
  EXPECT_EQ(hex(encode(SimStat{100, 50, 51, -1234, 5678, 0, -90})),
            "fa fb 3b 62 00 00 00 00 00 00 64 00 32 00 33 00 2e fb ff ff 2e 16 00 00 00 00 00 00 a6 ff ff ff "
            "00 00 00 00 00 00 00 00 00 00 00 00 ff ff ff ff 00 00 00 00 00 00 00 00 00 00 00 00 73 c7");
}

TEST(ArcosSimulator, HasThePositionOnTheEarthInTenMillionthsOfADegree) {
  // As above with the flag 2, 48.5° N = 485,000,000, 11.25° W = −112,500,000, 519.5 m = 51,950 cm and the quality 100.
  const SimStat stat{100, 50, 51, -1234, 5678, 0, -90, SimPosition{true, 485'000'000, -112'500'000, 51'950}};
  EXPECT_EQ(hex(encode(stat)).substr(0, 48 * 3 - 1),
            "fa fb 3b 62 00 00 02 00 00 00 64 00 32 00 33 00 2e fb ff ff 2e 16 00 00 00 00 00 00 a6 ff ff ff "
            "40 83 e8 1c e0 62 4b f9 ee ca 00 00 64 00 00 00");
  EXPECT_EQ(decodeSimStat(packetOf(encode(stat))), stat);
}

TEST(ArcosLaser, DividesAScanIntoPacketsOf32Readings) {
  std::vector<std::uint16_t> ranges(181);
  for (std::size_t i = 0; i < ranges.size(); ++i) ranges[i] = static_cast<std::uint16_t>(1000 + i);
  const std::string extended = encodeScan(LaserRequest::Form::extended, {.ranges_mm = ranges}, true);
  EXPECT_EQ(extended.size(), 5u * 173 + 118);
  EXPECT_EQ(hex(extended.substr(0, 14)), "fa fb aa 61 b5 00 00 00 20 e8 03 00 00 00");
  EXPECT_EQ(hex(extended.substr(169, 2)), "00 01");  // the first laser; moved
  for (const auto form : {LaserRequest::Form::ranges, LaserRequest::Form::extended}) {
    PacketReader reader;
    reader.add(encodeScan(form, {.ranges_mm = ranges}, false));
    ScanAssembler assembler;
    int packets = 0, scans = 0;
    while (auto packet = reader.next()) {
      ++packets;
      scans += assembler.add(*packet);
    }
    EXPECT_EQ(packets, 6);
    EXPECT_EQ(scans, 1);
    EXPECT_EQ(assembler.scan(), ranges);
  }
}

TEST(ArcosLaser, HasTheReflectanceOfEachBeamAndTheNumberOfTheLaser) {
  const std::vector<std::uint16_t> ranges{1000, 2000};
  const std::vector<std::uint8_t> reflectance{0, kReflector};
  const Scan scan{.ranges_mm = ranges, .reflectance = reflectance};
  const std::string extended = encodeScan(LaserRequest::Form::extended, scan, false, 1);
  EXPECT_EQ(hex(extended.substr(4, extended.size() - 6)),
            "02 00 00 00 02 e8 03 00 00 00 d0 07 21 00 00 01 00");  // 33 is 0x21; laser 1, not moved
  PacketReader reader;
  reader.add(extended);
  ScanAssembler first_laser;
  EXPECT_FALSE(first_laser.add(*reader.next())) << "of the second one";
  const std::string plain = encodeScan(LaserRequest::Form::ranges, scan, false);
  EXPECT_EQ(hex(plain.substr(4, plain.size() - 6)), "00 00 00 00 00 00 02 00 00 00 02 e8 03 d0 07");
}

TEST(ArcosSimulatorCommands, NamesTheMapToLoad) {
  const auto request = [](std::uint16_t operation, const std::string& text, std::uint16_t length) {
    ByteWriter bytes;
    bytes.add(std::uint8_t{0x2B}).add(operation).add(length).addText(text);
    return Packet{command::sim_control, bytes.bytes()};
  };
  EXPECT_EQ(decodeLoadMap(request(sim_operation::load_map, "other.map", 9)), "other.map");
  EXPECT_EQ(decodeLoadMap(request(sim_operation::load_map, "other.map", 10)), "other.map") << "with its NUL";
  EXPECT_EQ(decodeLoadMap(request(sim_operation::load_map, "other.map", 5)), "other");
  EXPECT_EQ(decodeLoadMap(request(sim_operation::request_info, "", 0)), "");
}

TEST(ArcosLaser, DropsAScanOfWhichAPartIsMissingOrTwice) {
  const std::vector<std::uint16_t> ranges(100, 500);
  for (const std::size_t fault : {0u, 1u, 2u}) {
    for (const bool is_twice : {false, true}) {
      PacketReader reader;
      for (int i = 0; i < 2; ++i) reader.add(encodeScan(LaserRequest::Form::extended, {.ranges_mm = ranges}, false));
      ScanAssembler assembler;
      int scans = 0;
      for (std::size_t i = 0; auto packet = reader.next(); ++i) {
        if (i != fault || is_twice) scans += assembler.add(*packet);
        if (i == fault && is_twice) scans += assembler.add(*packet);
      }
      EXPECT_EQ(scans, fault == 0 && is_twice ? 2 : 1) << fault << is_twice;
      EXPECT_EQ(assembler.scan(), ranges);
    }
  }
}

TEST(ArcosLaser, CountsTheBeamsOfARequest) {
  using Form = LaserRequest::Form;
  EXPECT_EQ((LaserRequest{Form::extended, -90, 90, 100}.beamCount()), 181u);
  EXPECT_EQ((LaserRequest{Form::extended, -135, 135, 50}.beamCount()), 541u);
  EXPECT_EQ((LaserRequest{Form::extended, -135, 135, 33}.beamCount()), 819u);
  EXPECT_EQ((LaserRequest{Form::extended, 0, 0, 100}.beamCount()), 1u);
  EXPECT_EQ((LaserRequest{Form::extended, 90, -90, 100}.beamCount()), 0u);
  EXPECT_EQ((LaserRequest{Form::extended, -90, 90, 0}.beamCount()), 0u);
  EXPECT_EQ((LaserRequest{Form::extended, -90, 90, -1}.beamCount()), 0u);
  EXPECT_EQ((LaserRequest{Form::extended, -180, 180, 1}.beamCount()), 0u);
}

TEST(ArcosSimulator, HasTheBytesOfAKnownPoseCommand) {
  const std::string bytes = encodeSetPose({500, 600, 90});
  EXPECT_EQ(hex(bytes), "fa fb 10 e0 00 f4 01 00 00 58 02 00 00 5a 00 00 00 86 03");
  const auto pose = decodeSetPose(packetOf(bytes));
  ASSERT_TRUE(pose);
  EXPECT_EQ(pose->x_mm, 500);
  EXPECT_EQ(pose->y_mm, 600);
  EXPECT_EQ(pose->heading_deg, 90);
  EXPECT_FALSE(decodeSetPose({command::sim_set_pose, "short"}));
}

TEST(ArcosSimulator, ReportsStateIn62Bytes) {
  const SimStat stat{100, 50, 51, -1234, 5678, 0, -90};
  const std::string bytes = encode(stat);
  EXPECT_EQ(bytes.size(), 62u);
  EXPECT_EQ(decodeSimStat(packetOf(bytes)), stat);
}

TEST(ArcosPorts, AreReadAsTheyWereWritten) {
  const EncoderTicks ticks{-5, 128'000};
  EXPECT_EQ(decodeEncoder(packetOf(encode(ticks))), ticks);
  EXPECT_EQ(hex(packetOf(encode(DigitalPorts{0xFF, 0x0F})).payload), "01 ff 01 0f 00");
}

}  // namespace
}  // namespace robosim::arcos
