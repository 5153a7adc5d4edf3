#include "net/listen.h"

#include <functional>

#include <gtest/gtest.h>

#include "base/error_list.h"
namespace robosim {
namespace {

std::string errorOf(const std::function<void()>& act) {
  try {
    act();
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "";
}

TEST(Listen, AcceptsOneAddressForAll) {
  const auto listen = ListenAddresses::parse("192.0.2.7:4000");
  for (const auto& address : listen.all()) EXPECT_EQ(address, "192.0.2.7:4000");
}

TEST(Listen, TakesThePortsOf2005) {
  const auto listen = ListenAddresses::parse("viewers=3000,robots=:8000,geometry=[::1]:10000");
  EXPECT_EQ(listen.viewers, "127.0.0.1:3000");
  EXPECT_EQ(listen.robots, "127.0.0.1:8000");
  EXPECT_EQ(listen.geometry, "[::1]:10000");
  EXPECT_EQ(listen.control, kDefaultListen);
}

TEST(Listen, RejectsInvalidAddressesAndKinds) {
  EXPECT_NE(errorOf([] { ListenAddresses::parse("viewers=host:80x"); }).find("must be host:port"), std::string::npos);
  EXPECT_NE(errorOf([] { ListenAddresses::parse("viewers=1,bogus=2"); }).find("'bogus=2' must be one of"),
            std::string::npos);
}

TEST(Listen, RequiresTlsAndTokensForOtherMachines) {
  const auto open = ListenAddresses::parse("geometry=0.0.0.0:1");
  EXPECT_EQ(errorOf([&] { checkExposure(open, true, true); }), "");
  EXPECT_EQ(errorOf([] { checkExposure(ListenAddresses::parse(":1"), false, false); }), "");
  EXPECT_NE(errorOf([&] { checkExposure(open, false, true); }).find("add --tls-cert"), std::string::npos);
  EXPECT_NE(errorOf([&] { checkExposure(open, true, false); }).find("add --tokens"), std::string::npos);
}

}  // namespace
}  // namespace robosim
