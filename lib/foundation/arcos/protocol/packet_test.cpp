#include "arcos/protocol/packet.h"

#include <gtest/gtest.h>

#include "arcos/protocol/command.h"
#include "arcos/protocol/testing/hex.h"
#include "base/random.h"

namespace robosim::arcos {
namespace {

std::vector<Packet> packetsIn(PacketReader& reader, std::string_view bytes) {
  reader.add(bytes);
  std::vector<Packet> packets;
  while (auto packet = reader.next()) packets.push_back(*packet);
  return packets;
}

Rng random(std::uint32_t run) { return Rng(1, RandomPurpose::test, run, 0, 0); }

Packet randomPacket(Rng& rng) {
  Packet packet{static_cast<std::uint8_t>(rng.below(256)), std::string(rng.below(kPayloadMax + 1), '\0')};
  for (char& byte : packet.payload) byte = static_cast<char>(rng.below(256));
  return packet;
}

// Packets seen between ARIA programs and simulators.
TEST(ArcosPacket, HasTheBytesOfKnownPackets) {
  EXPECT_EQ(hex(encodeCommand(command::sync0)), "fa fb 03 00 00 00");
  EXPECT_EQ(hex(encodeCommand(command::sync1)), "fa fb 03 01 00 01");
  EXPECT_EQ(hex(encodeCommand(command::sync2)), "fa fb 03 02 00 02");
  EXPECT_EQ(hex(encodeCommand(command::open, 1)), "fa fb 06 01 3b 01 00 02 3b");
  EXPECT_EQ(hex(encodeCommand(command::config, 1)), "fa fb 06 12 3b 01 00 13 3b");
  EXPECT_EQ(hex(encodeCommand(command::vel, 250)), "fa fb 06 0b 3b fa 00 05 3b");
  EXPECT_EQ(hex(encodeCommand(command::rvel, -10)), "fa fb 06 15 1b 0a 00 1f 1b");
  EXPECT_EQ(hex(encode(command::sync2, std::string_view("MobileSim\0Pioneer\0p3dx\0", 23))),
            "fa fb 1a 02 4d 6f 62 69 6c 65 53 69 6d 00 50 69 6f 6e 65 65 72 00 70 33 64 78 00 93 45");
}

TEST(ArcosPacket, CombinesALastSingleByteOfTheChecksumByXor) {
  EXPECT_EQ(hex(encodeCommand(command::sim_message, "hello")), "fa fb 0b ee 2b 05 68 65 6c 6c 6f 00 c5 6e");
}

TEST(ArcosPacket, RefusesAPayloadThatDoesNotFit) {
  EXPECT_EQ(encode(1, std::string(kPayloadMax, 'x')).size(), 258u);
  EXPECT_THROW(encode(1, std::string(kPayloadMax + 1, 'x')), std::invalid_argument);
}

TEST(ArcosCommand, ReadsNumbersOfEitherSignAndTexts) {
  PacketReader reader;
  const auto packets = packetsIn(reader, encodeCommand(command::head, -90) + encodeCommand(command::move, 5000) +
                                             encodeCommand(command::sim_message, "hello") + encodeCommand(0));
  ASSERT_EQ(packets.size(), 4u);
  EXPECT_EQ(numberOf(packets[0]), -90);
  EXPECT_EQ(numberOf(packets[1]), 5000);
  EXPECT_EQ(textOf(packets[2]), "hello");
  EXPECT_EQ(numberOf(packets[2]), std::nullopt);
  EXPECT_EQ(textOf(packets[0]), std::nullopt);
  EXPECT_EQ(numberOf(packets[3]), std::nullopt);
}

TEST(ArcosPacketReader, ReadsPacketsHoweverTheirBytesAreDivided) {
  Rng rng = random(1);
  for (int run = 0; run < 200; ++run) {
    std::vector<Packet> sent;
    std::string bytes;
    for (int i = 0; i < 5; ++i) bytes += encode(sent.emplace_back(randomPacket(rng)));
    PacketReader reader;
    std::vector<Packet> received;
    for (std::size_t at = 0; at < bytes.size();) {
      const std::size_t size = std::min<std::size_t>(1 + rng.below(40), bytes.size() - at);
      for (auto& packet : packetsIn(reader, std::string_view(bytes).substr(at, size))) received.push_back(packet);
      at += size;
    }
    ASSERT_EQ(received, sent);
    EXPECT_EQ(reader.rejectedBytes(), 0u);
    EXPECT_EQ(reader.pendingBytes(), 0u);
  }
}

TEST(ArcosPacketReader, LosesOnlyThePacketInWhichAByteIsWrong) {
  Rng rng = random(2);
  for (int run = 0; run < 500; ++run) {
    const Packet before = randomPacket(rng), hit = randomPacket(rng), after{7, "after"};
    std::string wrong = encode(hit);
    // Neither in the header's length, which would make the reader wait for bytes that do not come.
    const std::size_t at = 3 + rng.below(static_cast<std::uint32_t>(wrong.size() - 3));
    wrong[at] = static_cast<char>(wrong[at] ^ (1 + rng.below(255)));
    PacketReader reader;
    std::string bytes = encode(before) + wrong;
    // Random bytes within the wrong packet may look like a header; it then takes up to 258 bytes.
    for (int i = 0; i < 30; ++i) bytes += encode(after);
    const auto packets = packetsIn(reader, bytes);
    ASSERT_GE(packets.size(), 2u);
    EXPECT_EQ(packets.front(), before);
    EXPECT_EQ(packets.back(), after);
    EXPECT_EQ(std::count(packets.begin(), packets.end(), hit), 0);
  }
}

TEST(ArcosPacketReader, FindsAPacketThatFollowsATruncatedOne) {
  const std::string whole = encode(3, "0123456789");
  for (std::size_t size = 1; size < whole.size(); ++size) {
    PacketReader reader;
    const std::vector<Packet> next{{9, "next"}, {10, "next"}};
    auto packets = packetsIn(reader, whole.substr(0, size) + encode(next[0]) + encode(next[1]));
    // After "FA FB", or less of a packet than its length says, the reader waits for more bytes, until it is stalled.
    while (packets.size() < next.size() && reader.pendingBytes() > 0) {
      reader.abandonIncomplete();
      for (auto& packet : packetsIn(reader, {})) packets.push_back(packet);
    }
    EXPECT_EQ(packets, next) << "after " << size << " bytes";
  }
}

TEST(ArcosPacketReader, KeepsABoundedNumberOfBytesOfAnyInput) {
  Rng rng = random(3);
  PacketReader reader;
  for (int i = 0; i < 2000; ++i) {
    std::string noise(rng.below(64), '\0');
    for (char& byte : noise) byte = rng.below(4) == 0 ? '\xFA' : rng.below(3) == 0 ? '\xFB' : char(rng.below(256));
    packetsIn(reader, noise);
    ASSERT_LE(reader.pendingBytes(), 257u);
  }
}

}  // namespace
}  // namespace robosim::arcos
