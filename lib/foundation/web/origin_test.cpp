#include "web/origin.h"

#include <gtest/gtest.h>

namespace robosim {
namespace {

const char* const kHere = "127.0.0.1:8080";

TEST(Origin, PermitsPagesOfTheSameOrigin) {
  EXPECT_TRUE(isSameOrigin("http://127.0.0.1:8080", "127.0.0.1:8080", kHere));
  EXPECT_TRUE(isSameOrigin("http://localhost:8080", "localhost:8080", kHere));
  EXPECT_TRUE(isSameOrigin("http://LocalHost:8080", "localhost:8080", kHere));
  EXPECT_TRUE(isSameOrigin("http://[::1]:8080", "[::1]:8080", "[::1]:8080"));
  EXPECT_TRUE(isSameOrigin("http://localhost", "localhost", "127.0.0.1:80"));
  EXPECT_TRUE(isSameOrigin("https://sim.example.org", "sim.example.org", "0.0.0.0:443"));
}

TEST(Origin, RejectsPagesOfOtherOrigins) {
  EXPECT_FALSE(isSameOrigin("http://example.org", "127.0.0.1:8080", kHere));
  EXPECT_FALSE(isSameOrigin("http://127.0.0.1:8081", "127.0.0.1:8080", kHere));
  EXPECT_FALSE(isSameOrigin("http://localhost:8080", "127.0.0.1:8080", kHere));
  EXPECT_FALSE(isSameOrigin("null", "127.0.0.1:8080", kHere));
  EXPECT_FALSE(isSameOrigin("file://127.0.0.1:8080", "127.0.0.1:8080", kHere));
  EXPECT_FALSE(isSameOrigin("", "127.0.0.1:8080", kHere));
  EXPECT_FALSE(isSameOrigin("http://", "", kHere));
}

TEST(Origin, RejectsAHostThatIsNoHostAndPort) {
  for (const char* host :
       {"localhost:8080@evil.com", "localhost@evil.com", "user@localhost:8080", "localhost:8080:8080",
        "localhost:", "localhost:80a", "localhost:8080/", "localhost:8080?x", "localhost:8080#x", "local host:8080",
        ":8080", "[::1:8080", "[::1]8080", "[localhost]:8080", "[]:8080", "127.0.0.1\t:8080"}) {
    EXPECT_FALSE(isSameOrigin("http://" + std::string(host), host, kHere)) << host;
    EXPECT_FALSE(isSameOrigin("https://" + std::string(host), host, "0.0.0.0:8080")) << host;
  }
}

TEST(Origin, RejectsHostNamesThatWereReboundToThisMachine) {
  EXPECT_FALSE(isSameOrigin("http://evil.example:8080", "evil.example:8080", kHere));
  EXPECT_TRUE(isSameOrigin("http://sim.example.org:8080", "sim.example.org:8080", "0.0.0.0:8080"));
}

}  // namespace
}  // namespace robosim
