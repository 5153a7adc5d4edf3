#include "net/wire_error.h"

#include <gtest/gtest.h>

namespace robosim {
namespace {

TEST(WireError, NamesTheOlderProgramOfAVersionMismatch) {
  EXPECT_NO_THROW(checkProtocol(kProtocolVersion));
  for (const std::uint32_t version : {0u, 2u}) {
    try {
      checkProtocol(version);
      ADD_FAILURE();
    } catch (const WireError& error) {
      EXPECT_EQ(error.status().error_code(), grpc::StatusCode::FAILED_PRECONDITION);
      const std::string older = version < kProtocolVersion ? "the caller is the older" : "the environment is the older";
      EXPECT_NE(std::string(error.what()).find(older), std::string::npos) << error.what();
    }
  }
}

TEST(WireError, EscapesAndTruncatesQuotedTexts) {
  EXPECT_EQ(inQuotes("Robo"), "'Robo'");
  EXPECT_EQ(inQuotes("a\nb\x1b[2J\xff"), "'a?b?[2J?'");
  EXPECT_LT(inQuotes(std::string(1 << 20, 'x')).size(), 70u);
}

}  // namespace
}  // namespace robosim
