#include "net/host_port.h"

#include <gtest/gtest.h>

#include "base/error_list.h"

namespace robosim {
namespace {

TEST(HostPort, SplitsAtTheLastColonAndRemovesBrackets) {
  EXPECT_EQ(HostPort::of("example.org:80").host, "example.org");
  EXPECT_EQ(HostPort::of("example.org:80").port, "80");
  EXPECT_EQ(HostPort::of("[::1]:3000").host, "::1");
  EXPECT_EQ(HostPort::of("[::1]:3000").port, "3000");
  EXPECT_EQ(HostPort::of("example.org").host, "example.org");
  EXPECT_EQ(HostPort::of("example.org").port, "");
}

TEST(HostPort, CompletesAddresses) {
  EXPECT_EQ(hostAndPort("4000"), "127.0.0.1:4000");
  EXPECT_EQ(hostAndPort(":4000"), "127.0.0.1:4000");
  EXPECT_EQ(hostAndPort("[::1]:65535"), "[::1]:65535");
}

TEST(HostPort, RejectsInvalidAddresses) {
  for (const char* wrong : {"", "nonsense", "host:", "host:70000", "host:-1", "host:80x"}) {
    EXPECT_THROW(hostAndPort(wrong), ConfigError) << wrong;
  }
}

TEST(HostPort, ReplacesThePort) {
  EXPECT_EQ(withPort("127.0.0.1:0", 41234), "127.0.0.1:41234");
  EXPECT_EQ(withPort("[::1]:0", 41234), "[::1]:41234");
}

TEST(HostPort, RecognisesLoopbackAddresses) {
  for (const char* own : {"127.0.0.1:1", "127.9.8.7:1", "localhost:1", "[::1]:1"}) EXPECT_TRUE(isLoopback(own)) << own;
  for (const char* open :
       {"0.0.0.0:1", "[::]:1", "::1:3000", "192.0.2.7:1", "127.0.0.1.example.org:1", "example.org:1", "128.0.0.1:1"}) {
    EXPECT_FALSE(isLoopback(open)) << open;
  }
}

}  // namespace
}  // namespace robosim
