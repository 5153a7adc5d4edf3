// Fuzzes MCAP files: reads all messages and decodes them, then attachments, metadata, and from positions in any order.
#include <cstddef>
#include <filesystem>
#include <stdexcept>
#include <vector>

#include "mcap/reader.h"
#include "ros/cdr.h"
#include "ros/messages.h"
#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/rawlog_memory.h"

using namespace robosim;

namespace {

template <typename... M>
void decodeAs(std::span<const std::uint8_t> data) {
  const auto decode_one = [&](auto message) {
    try {
      ros::CdrReader(data).read(message);
    } catch (const ros::CdrError&) {
      return;
    }
    // What was decoded can be encoded, and decoded again.
    std::vector<std::uint8_t> bytes;
    ros::encode(message, bytes);
    ros::CdrReader(bytes).read(message);
  };
  (decode_one(M()), ...);
}

void decodeAll(std::span<const std::uint8_t> data) {
  using namespace ros;
  decodeAs<Clock, Header, String, LaserScan, Range, Odometry, BatteryState, Temperature, CompressedImage, CameraInfo,
           PointCloud2, TFMessage, OccupancyGrid, MarkerArray>(data);
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  decodeAll({data, size});
  const FileInMemory input(data, size);
  try {
    mcap::Reader reader(input.path());
    std::vector<mcap::Reader::Place> places;
    while (const auto message = reader.next()) {
      decodeAll(message->data);
      places.push_back(reader.place());
    }
    const mcap::Contents contents = reader.contents();
    for (const auto& index : contents.attachments) {
      try {
        reader.attachment(index);
      } catch (const mcap::RecordError&) {
      }
    }
    for (const auto& index : contents.metadata) {
      try {
        reader.metadata(index);
      } catch (const mcap::RecordError&) {
      }
    }
    for (std::size_t i = 0; i < 4 && !places.empty(); ++i) {
      const auto place = places[data[size - 1 - i] % places.size()];
      reader.seek(place);
      if (!reader.next()) throw std::logic_error("a message that was read before is not there again");
      if (reader.place() != place) throw std::logic_error("a message has moved");
    }
    reader.seekTime(size);
    reader.next();
  } catch (const ConfigError&) {
  }
  return 0;
}
