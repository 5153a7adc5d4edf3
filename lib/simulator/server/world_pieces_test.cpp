#include "server/world_pieces.h"

#include <gtest/gtest.h>

#include "net/wire_error.h"
#include "wire/world_wire.h"

namespace robosim {
namespace {

std::string serialised(const WorldSource& source) {
  v1::WorldSource message;
  encode(source, message);
  return message.SerializeAsString();
}

std::string complaintOf(WorldPieces& pieces, const std::string& piece) {
  try {
    pieces.add(piece);
    return "";
  } catch (const WireError& error) {
    return error.what();
  }
}

TEST(WorldPieces, RestoreTheWorld) {
  const WorldSource sent = readWorldSource(ROBOSIM_SOURCE_DIR "/worlds/small_maze.xml");
  const std::string bytes = serialised(sent);
  for (const std::size_t size : {std::size_t{1}, std::size_t{1000}, bytes.size()}) {
    WorldPieces pieces;
    for (std::size_t at = 0; at < bytes.size(); at += size) pieces.add(bytes.substr(at, size));
    EXPECT_EQ(pieces.bytes(), bytes.size());
    EXPECT_EQ(versionOf(pieces.takeSource()), versionOf(sent)) << size;
  }
}

TEST(WorldPieces, HaveAtMost128MiBTogether) {
  WorldPieces pieces;
  const std::string mebibyte(1 << 20, 'x');
  for (int i = 0; i < 128; ++i) ASSERT_EQ(complaintOf(pieces, mebibyte), "");
  EXPECT_EQ(complaintOf(pieces, "x"),
            "a world of more than 128 MiB; send fewer or smaller maps, or start the environment with the world's file");
}

TEST(WorldPieces, RefuseBytesThatAreNoWorldSource) {
  WorldPieces none;
  EXPECT_THROW(none.takeSource(), WireError);
  WorldPieces noise;
  noise.add("\xff\xff\xff\xff");
  EXPECT_THROW(noise.takeSource(), WireError);
}

}  // namespace
}  // namespace robosim
