// Malformed maps, with the error text and position for each; and randomly damaged maps, which must be read or rejected
// without undefined behaviour.
#include <cstring>
#include <limits>
#include <sstream>

#define OCTOMAP_NODEBUGOUT  // otherwise it logs to standard error
#include <gtest/gtest.h>
#include <isa-l/igzip_lib.h>
#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/poses/CPose3DPDFGaussian.h>
#include <octomap/OcTree.h>

#include "base/random.h"
#include "world/maps/testing/map_samples.h"

namespace robosim {
namespace {

using Lines = std::vector<std::string>;

MapReading ofPixels(double pixel_m) {
  MapReading reading;
  reading.pixel_m = pixel_m;
  return reading;
}

mrpt::maps::COccupancyGridMap2D smallGrid() {
  mrpt::maps::COccupancyGridMap2D grid(0, 1.5f, 0, 1, 0.25f);  // 6 × 4 cells
  grid.fill(0.9f);
  for (int x = 0; x < 6; ++x) grid.setCell(x, 0, 0.1f);
  return grid;
}

std::string gzipped(const std::string& bytes) {
  std::string out(bytes.size() + 1000, '\0');
  isal_zstream stream;
  isal_deflate_stateless_init(&stream);
  stream.gzip_flag = IGZIP_GZIP;
  stream.end_of_stream = 1;
  stream.next_in = reinterpret_cast<std::uint8_t*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<std::uint32_t>(bytes.size());
  stream.next_out = reinterpret_cast<std::uint8_t*>(out.data());
  stream.avail_out = static_cast<std::uint32_t>(out.size());
  EXPECT_EQ(isal_deflate_stateless(&stream), COMP_OK);
  out.resize(stream.total_out);
  return out;
}

/// Offsets of the fields of a grid map's header.
enum GridmapField : std::size_t {
  version_at = 32,
  bits_at = 33,
  size_x_at = 34,
  size_y_at = 38,
  x_min_at = 42,
  x_max_at = 46,
  y_min_at = 50,
  y_max_at = 54,
  resolution_at = 58,
  cells_at = 62
};

template <typename Value>
std::string with(std::string bytes, std::size_t at, Value value) {
  std::memcpy(bytes.data() + at, &value, sizeof value);
  return bytes;
}

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinite = std::numeric_limits<float>::infinity();

TEST(MalformedMaps, ReportsFaultsOfMrptFiles) {
  const std::string good = gridmapBytes(smallGrid());
  ASSERT_EQ(faultsOf("a.gridmap", {{"a.gridmap", good}}), Lines{});
  ASSERT_EQ(faultsOf("a.gridmap.gz", {{"a.gridmap.gz", gzipped(good)}}), Lines{});
  std::string huge = with(with(good, size_x_at, 1u << 20), size_y_at, 1u << 20);
  huge = with(with(huge, x_max_at, 1048576 * 0.25f), y_max_at, 1048576 * 0.25f);
  const std::string bomb = gzipped(std::string(140u << 20, '\0'));
  ASSERT_LT(bomb.size(), 2u << 20);

  const struct {
    std::string bytes, fault;
  } cases[] = {
      {"", "is not an MRPT grid map: it does not begin with a COccupancyGridMap2D"},
      {"\x9f", "is not an MRPT grid map: it does not begin with a COccupancyGridMap2D"},
      {"<world/>", "is not an MRPT grid map: it does not begin with a COccupancyGridMap2D"},
      {"\x8bmrpt::X::Y", "is not an MRPT grid map: it does not begin with a COccupancyGridMap2D"},
      {good.substr(0, 32), "is cut off: the version is missing"},
      {with(good, version_at, std::int8_t{1}), "is a COccupancyGridMap2D of version 1; versions 2 to 6 are read"},
      {with(good, version_at, std::int8_t{77}), "is a COccupancyGridMap2D of version 77; versions 2 to 6 are read"},
      {with(good, bits_at, std::uint8_t{32}), "a cell has 32 bits; it must have 8 or 16"},
      {good.substr(0, 36), "is cut off: size_x is missing"},
      {with(good, size_x_at, 7u), "size_x is 7, but from x_min to x_max there are 6 cells"},
      {with(good, size_y_at, 0u), "size_y is 0, but from y_min to y_max there are 4 cells"},
      {with(good, size_y_at, 0xffffffffu), "size_y is 4294967295, but from y_min to y_max there are 4 cells"},
      {with(good, x_min_at, kNan), "x_min is nan; it must lie within ±1e7 metres"},
      {with(good, x_max_at, kInfinite), "x_max is inf; it must lie within ±1e7 metres"},
      {with(good, x_max_at, -1.5f), "size_x is 6, but from x_min to x_max there are -6 cells"},
      {with(good, y_min_at, -2e7f), "y_min is -2e+07; it must lie within ±1e7 metres"},
      {with(good, resolution_at, kNan), "resolution is nan; it must lie within ±1e7 metres"},
      {with(good, resolution_at, 0.0f), "resolution is 0; it must lie in (0, 100] metres"},
      {with(good, resolution_at, -0.25f), "resolution is -0.25; it must lie in (0, 100] metres"},
      {with(good, resolution_at, 0.125f), "size_x is 6, but from x_min to x_max there are 12 cells"},
      {huge, "has 1048576 × 1048576 cells; a map may have 67108864 at most"},
      {good.substr(0, cells_at + 10), "is cut off: it has bytes for 10 of its 24 cells"},
      {good.substr(0, cells_at + 24), "is cut off: the end of the object is missing"},
      {good.substr(0, good.size() - 1), "is cut off: the end of the object is missing"},
      {gzipped(good).substr(0, 60), "is cut off: the compressed part has no end"},
      {std::string("\x1f\x8b\x08\x00\x00\x00\x00\x00\x00\x03\xff\xff\xff\xff", 14),
       "is damaged: it cannot be decompressed beyond byte 0"},
      {bomb, "holds more than 129 MiB once it is decompressed; no map has so many cells"},
  };
  for (const auto& [bytes, fault] : cases) {
    EXPECT_EQ(faultsOf("a.gridmap", {{"a.gridmap", bytes}}), Lines{"maps/a.gridmap: " + fault});
  }
}

TEST(MalformedMaps, ReportsFaultsOfRosFiles) {
  const std::string image = "P2 1 1 255 0";
  const std::string good = rosYaml("a.pgm");
  const auto faults = [&](const std::string& yaml) { return faultsOf("a.yaml", {{"a.yaml", yaml}, {"a.pgm", image}}); };
  ASSERT_EQ(faults(good), Lines{});
  const auto changed = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    return text.replace(text.find(from), from.size(), to);
  };
  const std::string in_resolution = ": must be a number in (0, 100] metres per pixel";

  const struct {
    std::string yaml;
    Lines faults;
  } cases[] = {
      {"", {"1: is not a map_server map; expected image: and other keys"}},
      {"just words", {"1: is not a map_server map; expected image: and other keys"}},
      {"- a\n- list", {"1: is not a map_server map; expected image: and other keys"}},
      {"image: a.pgm\nresolution: [1, 2\n", {"3: this is not YAML: end of sequence flow not found"}},
      {"image: a.pgm\n\tresolution: 1", {"2: this is not YAML: illegal tab when looking for indentation"}},
      {std::string(300, '['), {"1: this is not YAML: "}},
      {"resolution: 1",
       {"1: image: is missing; add it", "1: origin: is missing; add it", "1: negate: is missing; add it",
        "1: occupied_thresh: is missing; add it", "1: free_thresh: is missing; add it"}},
      {changed("a.pgm", "[a, b]"), {"1: image: is not a single value"}},
      {changed("a.pgm", "''"), {"1: image: is empty; give a value"}},
      {changed("0.05", ".nan"), {"2: resolution: .nan" + in_resolution}},
      {changed("0.05", "nan"), {"2: resolution: nan" + in_resolution}},
      {changed("0.05", "inf"), {"2: resolution: inf" + in_resolution}},
      {changed("0.05", "0"), {"2: resolution: 0" + in_resolution}},
      {changed("0.05", "-0.05"), {"2: resolution: -0.05" + in_resolution}},
      {changed("0.05", "1e300"), {"2: resolution: 1e300" + in_resolution}},
      {changed("0.05", "5 cm"), {"2: resolution: 5 cm" + in_resolution}},
      {changed("[-1.5, 2.0, 0.0]", "[0, 0]"), {"3: origin: must be [x, y, yaw], in metres and radians"}},
      {changed("[-1.5, 2.0, 0.0]", "0"), {"3: origin: 0: must be [x, y, yaw], in metres and radians"}},
      {changed("-1.5", "nan"), {"3: origin: nan: must be a number in [-1e+07, 1e+07] metres"}},
      {changed("2.0", "[1]"), {"3: origin: must be a number in [-1e+07, 1e+07] metres"}},
      {changed("2.0", "1e8"), {"3: origin: 1e8: must be a number in [-1e+07, 1e+07] metres"}},
      {changed("negate: 0", "negate: maybe"), {"4: negate: maybe: must be 0 or 1"}},
      {changed("0.65", "1.5"), {"5: occupied_thresh: 1.5: must be a number in [0, 1]"}},
      {changed("0.65", "0.1"), {"6: free_thresh: 0.196: is above occupied_thresh"}},
      {good + "mode: quaternary\n", {"7: mode: quaternary: is unknown; accepted are: trinary, scale, raw"}},
  };
  for (const auto& [yaml, expected] : cases) {
    const Lines found = faults(yaml);
    ASSERT_EQ(found.size(), expected.size()) << yaml;
    for (std::size_t i = 0; i < found.size(); ++i) {
      EXPECT_TRUE(found[i].starts_with("maps/a.yaml:" + expected[i])) << found[i] << "\nis not\n" << expected[i];
    }
  }
  EXPECT_EQ(faultsOf("a.yaml", {{"a.yaml", good}}),
            Lines{"maps/a.yaml:1: image: a.pgm: maps/a.pgm: did not come with the world"});
  EXPECT_EQ(faultsOf("a.yaml", {{"a.yaml", std::string(2 << 20, ' ')}}),
            Lines{"maps/a.yaml: is larger than 1 MiB; is it a map's .yaml?"});
  EXPECT_EQ(
      faultsOf("a.yaml", {{"a.yaml", changed("0.05", "100")}, {"a.pgm", "P5 1 1 255\n"}}),
      Lines{"maps/a.yaml:1: image: a.pgm: maps/a.pgm: is cut off: its pixels take at least 1 bytes, and 0 are left"});
}

std::string bigEndian(std::size_t value) {
  std::string bytes;
  for (const int shift : {24, 16, 8, 0}) bytes += static_cast<char>(value >> shift);
  return bytes;
}

/// A chunk of a PNG file with its correct check sum.
std::string chunk(const std::string& type, const std::string& data) {
  std::uint32_t crc = 0xffffffff;  // bit by bit: PNG specification, annex D
  for (const char c : type + data) {
    crc ^= static_cast<unsigned char>(c);
    for (int i = 0; i < 8; ++i) crc = crc & 1 ? crc >> 1 ^ 0xedb88320 : crc >> 1;
  }
  return bigEndian(data.size()) + type + data + bigEndian(crc ^ 0xffffffff);
}

TEST(MalformedMaps, ReportsFaultsOfPictures) {
  const std::string good = pngBytes(cv::Mat(20, 30, CV_8U, cv::Scalar(0)));
  ASSERT_EQ(faultsOf("a.png", {{"a.png", good}}, ofPixels(0.05)), Lines{});
  const std::string signature = good.substr(0, 8);
  const auto header = [](std::size_t width, std::size_t height) {
    return chunk("IHDR", bigEndian(width) + bigEndian(height) + std::string("\x08\x00\x00\x00\x00", 5));
  };
  std::string flipped = good;
  flipped[45] = static_cast<char>(flipped[45] ^ 1);

  cv::Mat chequered(3000, 3000, CV_8U);
  chequered.forEach<uchar>([](uchar& cell, const int* at) { cell = (at[0] + at[1]) % 2 == 0 ? 0 : 255; });

  const struct {
    std::string bytes, fault;
  } cases[] = {
      {pngBytes(chequered),
       ": its occupied cells are so scattered that they make 4500000 boxes; a map may have 4000000 at most, so make it "
       "smaller, or its cells larger"},
      {"", ": is no PNG, PGM, PPM, PBM, BMP or JPEG picture; save it as one of these"},
      {"P7\nWIDTH 1", ": is no PNG, PGM, PPM, PBM, BMP or JPEG picture; save it as one of these"},
      {"GIF89a", ": is no PNG, PGM, PPM, PBM, BMP or JPEG picture; save it as one of these"},
      {signature, ": is cut off: the part at byte 8 is missing"},
      {good.substr(0, 20), ": is cut off within the part at byte 8"},
      {good.substr(0, 50), ": is cut off within the part at byte 33"},
      {good.substr(0, good.size() - 12),
       ": is cut off: the part at byte " + std::to_string(good.size() - 12) + " is missing"},
      {flipped, ": is damaged: the part at byte 33 has a wrong check sum"},
      {signature + chunk("IDAT", "xxx") + chunk("IEND", ""), ": is damaged: it has no header"},
      {signature + header(0, 1) + chunk("IEND", ""), ": its header declares 0 × 1 pixels, which is empty"},
      {signature + header(0x7fffffff, 0x7fffffff) + chunk("IEND", ""),
       ": its header declares 2147483647 × 2147483647 pixels; a map may have 67108864 cells at most, so make it "
       "smaller"},
      {"P5", ": is no PNG, PGM, PPM, PBM, BMP or JPEG picture; save it as one of these"},
      {"P5\n", ":2: the width is missing"},
      {"P5\n# only a comment", ":2: the width is missing"},
      {"P5\nwide", ":2: the width is missing"},
      {"P5\n-3 4 255\n", ":2: the width is missing"},
      {"P5\n3.5 4 255\n", ":2: the width is not a whole number"},
      {"P5\n99999999999 4 255\n", ":2: the width is too large; 67108864 is the maximum"},
      {"P5\n60000 60000 255\n",
       ": its header declares 60000 × 60000 pixels; a map may have 67108864 cells at most, so make it smaller"},
      {"P5\n0 4 255\n", ": its header declares 0 × 4 pixels, which is empty"},
      {"P5\n2 2", ":2: the value of white is missing"},
      {"P5\n2 2\n0\n....", ":3: the value of white is 0; it must lie in [1, 65535]"},
      {"P5\n2 2\n65536\n....", ":3: the value of white is too large; 65535 is the maximum"},
      {"P5\n2 2\n255\n...", ": is cut off: its pixels take at least 4 bytes, and 3 are left"},
      {"P5\n2 2\n256\n.......", ": is cut off: its pixels take at least 8 bytes, and 7 are left"},
      {"P6\n2 2\n255\n...........", ": is cut off: its pixels take at least 12 bytes, and 11 are left"},
      {"P4\n9 2\n...", ": is cut off: its pixels take at least 4 bytes, and 3 are left"},
      {"P5\n2 2\n255", ": is cut off: its pixels take at least 4 bytes, and 0 are left"},
      {"P2\n8000 8000\n255\n1 2 3", ": is cut off: its pixels take at least 127999999 bytes, and 6 are left"},
      {"P2\n2 2\n255\n1 2 300 4", ":4: a value is too large; 255 is the maximum"},
      {"P2\n2 2\n255\n1 2\n3      ", ":5: a value is missing"},
      {"P1\n2 2\n0 1 2 1", ":3: a pixel is neither 0 nor 1"},
      {"P5\n2 2\n100\n..\xff.", ":4: the value 255 is more than white, 100"},
  };
  for (const auto& [bytes, fault] : cases) {
    EXPECT_EQ(faultsOf("a.png", {{"a.png", bytes}}, ofPixels(0.05)), Lines{"maps/a.png" + fault});
  }
  EXPECT_EQ(faultsOf("a.pgm", {{"a.pgm", "P1 200001 1 " + std::string(200'001, '0')}}, ofPixels(100)),
            Lines{"maps/a.pgm: reaches over more than 10,000 km; its resolution cannot be right"});
}

TEST(MalformedMaps, ReportsFaultsOfActivmediaFiles) {
  const struct {
    std::string text, fault;
  } cases[] = {
      {"", "1: is not an ActivMedia map: its first line is not 2D-Map"},
      {"\n2D-Map\n", "1: is not an ActivMedia map: its first line is not 2D-Map"},
      {"2D-Map-Ex5\n", "1: is not an ActivMedia map: its first line is not 2D-Map"},
      {"2D-Map\nResolution: fine\n",
       "2: the resolution must be a number in [0, 100000] millimetres; 0 stands for the usual one, 20"},
      {"2D-Map\nResolution: nan\n",
       "2: the resolution must be a number in [0, 100000] millimetres; 0 stands for the usual one, 20"},
      {"2D-Map\nResolution:\n",
       "2: the resolution must be a number in [0, 100000] millimetres; 0 stands for the usual one, 20"},
      {"2D-Map\nResolution: -20\n",
       "2: the resolution must be a number in [0, 100000] millimetres; 0 stands for the usual one, 20"},
      {"2D-Map\nResolution: 1e-9\n", "2: the resolution must be 0 or at least 1 millimetre"},
      {"2D-Map\nLINES\n1 2 3\n", "3: '1 2 3' is not a wall, x1 y1 x2 y2 in millimetres"},
      {"2D-Map\nLINES\n1 2 3 four\n", "3: '1 2 3 four' is not a wall, x1 y1 x2 y2 in millimetres"},
      {"2D-Map\nLINES\n1 2 3 nan\n", "3: '1 2 3 nan' is not a wall, x1 y1 x2 y2 in millimetres"},
      {"2D-Map\nLINES\n1 2 3 4\n\nDATA\n5\n", "6: '5' is not a point, x y in millimetres"},
      {"2D-Map\r\nDATA\r\n1 1e10\r\n", "3: lies more than 1,000 km from the origin; coordinates are in millimetres"},
      {"2D-Map\nCairn: RobotHome 1 2\n",
       "2: a cairn has a type, x, y, theta, a name, an icon and a label; something is missing"},
      {"2D-Map\nLINES\n\nCairn: Dock 1 inf 0 \"\" ICON \"\"\n", "4: 'inf' of the cairn Dock is not a number"},
  };
  for (const auto& [text, fault] : cases) {
    EXPECT_EQ(faultsOf("a.map", {{"a.map", text}}), Lines{"maps/a.map:" + fault}) << text;
  }
}

TEST(MalformedMaps, RejectsUnknownFileNames) {
  for (const char* name : {"a.gif", "a", "", "gridmap", "a.yaml.bak"}) {
    EXPECT_EQ(
        faultsOf(name, {{name, ""}}),
        Lines{std::string(name) + ": is not a map by its name; maps end in .gridmap, .simplemap, .bt, .ot, .yaml (of "
                                  "ROS), .png, .jpg, .bmp, .pgm, .ppm, .pbm or .map"});
  }
  EXPECT_EQ(recognizeMapFormat("A.GridMap.GZ"), MapFormat::gridmap);
  EXPECT_EQ(recognizeMapFormat("x/y.YML"), MapFormat::ros_yaml);
}

/// Frames with a scan of three beams each.
std::string simpleMapBytes(int frames) {
  mrpt::maps::CSimpleMap map;
  for (int i = 0; i < frames; ++i) {
    auto scan = mrpt::obs::CObservation2DRangeScan::Create();
    scan->maxRange = 3;
    scan->resizeScan(3);
    for (std::size_t beam = 0; beam < 3; ++beam) {
      scan->setScanRange(beam, 1);
      scan->setScanRangeValidity(beam, true);
    }
    auto frame = mrpt::obs::CSensoryFrame::Create();
    frame->insert(scan);
    map.insert(mrpt::poses::CPose3DPDFGaussian(mrpt::poses::CPose3D(0.1 * i, 0, 0, 0, 0, 0)), *frame);
  }
  mrpt::io::CMemoryStream stream;
  mrpt::serialization::archiveFrom(stream) << map;
  return {static_cast<const char*>(stream.getRawBufferData()), static_cast<std::size_t>(stream.getTotalBytesCount())};
}

std::string octomapBytes(bool is_binary) {
  octomap::OcTree tree(0.5);
  for (const float x : {0.25F, 0.75F, 1.25F}) tree.updateNode(octomap::point3d(x, 0.25F, 0.25F), x < 1);
  std::ostringstream out;
  if (is_binary) {
    out << "# Octomap OcTree binary file\nid OcTree\nsize 9\nres 0.5\ndata\n";
    tree.writeBinaryData(out);
  } else {
    tree.write(out);
  }
  return out.str();
}

/// Flips bits, and removes, duplicates and inserts runs of bytes.
std::string damaged(std::string bytes, Rng& rng) {
  for (auto blows = 1 + rng.below(4); blows > 0 && !bytes.empty(); --blows) {
    const auto size = static_cast<std::uint32_t>(bytes.size());
    const auto at = rng.below(rng.below(2) ? size : std::min(size, 100u));
    const auto run = rng.below(std::min(40u, size - at) + 1);
    switch (rng.below(6)) {
      case 0:
        bytes.resize(at);
        break;
      case 1:
        bytes.erase(at, run);
        break;
      case 2:
        bytes.insert(at, bytes.substr(at, run));
        break;
      case 3:
        bytes.insert(at, run, static_cast<char>(rng.below(256)));
        break;
      case 4:
        bytes[at] = "0123456789-.en[]:# \n"[rng.below(20)];
        break;
      default:
        bytes[at] = static_cast<char>(bytes[at] ^ (1 << rng.below(8)));
    }
  }
  return bytes;
}

TEST(MalformedMaps, RandomlyDamagedAreReadOrRejected) {
  const std::string pgm = "P5\n# a\n6 4\n255\n" + std::string(24, '\x80');
  const FileTexts good{
      {"a.gridmap", gridmapBytes(smallGrid())},
      {"b.gridmap", gzipped(gridmapBytes(smallGrid()))},
      {"a.simplemap", simpleMapBytes(3)},
      {"a.bt", octomapBytes(true)},
      {"a.ot", octomapBytes(false)},
      {"a.yaml", rosYaml("a.pgm")},
      {"a.pgm", pgm},
      {"b.pgm", "P2 6 1 9 0 1 2 3 4 9"},
      {"c.pbm", "P1 6 2 010101 1 1 1 0 0 0"},
      {"a.png", pngBytes(cv::Mat(4, 6, CV_8UC4, cv::Scalar(9)))},
      {"a.map",
       "2D-Map\nResolution: 20\nMapInfo: SectorType Name=B Sim.Obstacle=yes\nCairn: B 1 2 3 \"\" ICON \"\" 1 2 3 "
       "4\nCairn: RobotHome 1 2 3 \"\" ICON \"a b\" 1 2 3 4\nLINES\n1 2 3 4\n-5 6 7 8\nDATA\n20 40\n60 80\n"}};
  std::size_t read = 0, refused = 0;
  for (const auto& [name, bytes] : good) {
    ASSERT_EQ(faultsOf(name, good, ofPixels(0.05)), Lines{}) << name;
    const std::uint64_t seeds = name == "a.simplemap" ? 30 : 1500;  // MRPT takes 0.1 s to describe an exception
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
      Rng rng(seed, RandomPurpose::test);
      FileTexts files = good;
      files[name] = damaged(bytes, rng);
      ++(faultsOf(name, files, ofPixels(0.05)).empty() ? read : refused);
    }
  }
  EXPECT_GT(read, 500u);
  EXPECT_GT(refused, 5000u);
}

}  // namespace
}  // namespace robosim
