// Counts the messages that Fast DDS receives, for measurements of `robosim serve --ros2`:
//   robosim_count_messages DOMAIN SECONDS TYPE TOPIC…
//   robosim_count_messages 7 10 sensor_msgs::msg::dds_::LaserScan_ /Pioneer1/scan /Pioneer2/scan
#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <thread>

#include "tests/dds/fast_dds_peer.h"

int main(int argc, char** argv) {
  if (argc < 5) {
    std::cerr << "usage: robosim_count_messages DOMAIN SECONDS TYPE TOPIC...\n";
    return 1;
  }
  std::atomic<std::uint64_t> messages{0}, bytes{0};
  fast::Peer peer(std::atoi(argv[1]));
  std::vector<std::unique_ptr<fast::Peer::Endpoint>> readers;
  for (int i = 4; i < argc; ++i) {
    readers.push_back(peer.reader(std::string("rt") + argv[i], argv[3], {false, false, 5},
                                  [&](const std::vector<std::uint8_t>& message) {
                                    ++messages;
                                    bytes += message.size();
                                  }));
  }
  // What is measured is what arrives in this time.
  std::this_thread::sleep_for(std::chrono::duration<double>(std::atof(argv[2])));
  std::cout << messages << " messages, " << bytes << " bytes\n";
}
