#include "dds/cyclone_config.h"

#include <gtest/gtest.h>

#include "base/error_list.h"

namespace robosim::dds {
namespace {

TEST(CycloneConfig, FindsProgramsOfThisMachineOnlyUnlessAnInterfaceIsNamed) {
  EXPECT_EQ(cycloneConfig({}),
            "<CycloneDDS><Domain><General><Interfaces><NetworkInterface autodetermine=\"true\"/></Interfaces>"
            "<MulticastTimeToLive>0</MulticastTimeToLive></General><Discovery>"
            "<ParticipantIndex>auto</ParticipantIndex><MaxAutoParticipantIndex>99</MaxAutoParticipantIndex>"
            "<SPDPInterval>2s</SPDPInterval><Peers><Peer address=\"127.0.0.1\"/></Peers></Discovery></Domain>"
            "</CycloneDDS>");
}

TEST(CycloneConfig, UsesMulticastOfAnInterfaceAndAddressesOfPeers) {
  const std::string config = cycloneConfig({.interface = "eth0", .peers = {"192.0.2.7", "robot1.example.org"}});
  EXPECT_NE(config.find("<NetworkInterface name=\"eth0\"/>"), std::string::npos) << config;
  EXPECT_NE(config.find("<Peer address=\"192.0.2.7\"/><Peer address=\"robot1.example.org\"/></Peers>"),
            std::string::npos)
      << config;
  EXPECT_EQ(config.find("TimeToLive"), std::string::npos) << config;
  EXPECT_NE(cycloneConfig({.interface = "192.0.2.1"}).find("<NetworkInterface address=\"192.0.2.1\"/>"),
            std::string::npos);
}

TEST(CycloneConfig, RefusesTextThatIsNoAddress) {
  EXPECT_THROW(cycloneConfig({.interface = "eth0\"/><X a=\""}), ConfigError);
  EXPECT_THROW(cycloneConfig({.peers = {""}}), ConfigError);
}

}  // namespace
}  // namespace robosim::dds
