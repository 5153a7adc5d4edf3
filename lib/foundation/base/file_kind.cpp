#include "base/file_kind.h"

#include <algorithm>
#include <array>
#include <cctype>

#include <zlib.h>

#include "base/error_list.h"
#include "base/input_file.h"

namespace robosim {
namespace {

constexpr std::string_view kSpace = " \t\r\n";

/// The text without white space, XML declarations, and comments at its beginning.
std::string_view withoutXmlProlog(std::string_view text) {
  while (true) {
    text.remove_prefix(std::min(text.find_first_not_of(kSpace), text.size()));
    const std::string_view end = text.starts_with("<?") ? "?>" : text.starts_with("<!--") ? "-->" : "";
    if (end.empty()) return text;
    const std::size_t at = text.find(end);
    if (at == std::string_view::npos) return {};
    text.remove_prefix(at + end.size());
  }
}

FileKind kindOfXml(std::string_view text) {
  text = withoutXmlProlog(text);
  if (text.empty()) return FileKind::other_xml;
  const std::string_view name = text.substr(1, text.find_first_of(" \t\r\n/>", 1) - 1);
  if (name == "world") return FileKind::world;
  if (name == "robot") return FileKind::robot_type;
  if (name == "RobotInfo") return FileKind::robot_list;
  return FileKind::other_xml;
}

/// The class name with which MRPT's serialised objects begin: its length, whose highest bit is set in newer versions,
/// and its letters. Empty for other files.
std::string_view mrptClass(std::string_view bytes) {
  // Versions before 2008 wrote the length in four bytes.
  const std::size_t prefix = bytes.size() > 4 && bytes.substr(1, 3) == std::string_view("\0\0\0", 3) ? 4 : 1;
  const std::size_t length = bytes.empty() ? 0 : static_cast<unsigned char>(bytes[0]) & 0x7fu;
  if (length < 4 || bytes.size() < prefix + length) return {};
  const std::string_view name = bytes.substr(prefix, length);
  const bool is_name = std::all_of(name.begin(), name.end(),
                                   [](unsigned char c) { return std::isalnum(c) != 0 || c == ':' || c == '_'; });
  const std::size_t scope = name.rfind(':');
  const std::string_view plain = scope == std::string_view::npos ? name : name.substr(scope + 1);
  return is_name && plain.size() > 2 && plain[0] == 'C' && std::isupper(static_cast<unsigned char>(plain[1])) != 0
             ? plain
             : std::string_view{};
}

/// The first line that is no comment, and is not empty.
std::string_view firstLine(std::string_view text) {
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    line.remove_prefix(std::min(line.find_first_not_of(kSpace), line.size()));
    if (!line.empty() && line[0] != '#') return line;
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return {};
}

/// Whether a file that begins with a word is a world of Stage, by what follows it on its line.
bool isOfStage(std::string_view word, std::string_view rest) {
  constexpr std::array<std::string_view, 20> kStage{
      "define",  "include",     "window",     "floorplan",    "model",        "position", "resolution",
      "size",    "name",        "paused",     "quit_time",    "interval_sim", "speedup",  "interval_real",
      "threads", "unit_length", "unit_angle", "gui_interval", "show_clock",   "map"};
  if (std::find(kStage.begin(), kStage.end(), word) == kStage.end()) return false;
  rest.remove_prefix(std::min(rest.find_first_not_of(kSpace), rest.size()));
  if (word == "define") return !rest.empty();
  if (word == "include") return rest.starts_with('"');
  // An entity may open on the next line.
  const bool is_entity = rest.empty() && (word == "window" || word == "floorplan" || word == "model" ||
                                          word == "position" || word == "map");
  return is_entity || (!rest.empty() && std::string_view("([\"+-.0123456789#").find(rest[0]) != std::string_view::npos);
}

FileKind kindOfText(std::string_view text) {
  const std::string_view line = firstLine(text);
  const std::string_view word = line.substr(0, line.find_first_of(" \t\r("));
  constexpr std::array<std::string_view, 11> kCarmen{"FLASER",      "RLASER",    "ODOM", "PARAM",
                                                     "TRUEPOS",     "NMEAGGA",   "SYNC", "ROBOTLASER1",
                                                     "ROBOTLASER2", "RAWLASER1", "LASER"};
  if (text.starts_with("# CARMEN") || std::find(kCarmen.begin(), kCarmen.end(), word) != kCarmen.end()) {
    return FileKind::carmen_log;
  }
  if (isOfStage(word, line.substr(word.size()))) return FileKind::stage_world;
  if (text.starts_with("image:") || text.find("\nimage:") != std::string_view::npos) return FileKind::ros_yaml;
  return FileKind::unknown;
}

/// The beginning of a gzip file's content.
std::string unpacked(const std::string& beginning) {
  constexpr int kGzip = 15 + 16;
  z_stream stream{};
  if (inflateInit2(&stream, kGzip) != Z_OK) return {};
  std::string content(1024, '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(beginning.data()));  // only read
  stream.avail_in = static_cast<uInt>(beginning.size());
  stream.next_out = reinterpret_cast<Bytef*>(content.data());
  stream.avail_out = static_cast<uInt>(content.size());
  inflate(&stream, Z_SYNC_FLUSH);
  content.resize(content.size() - stream.avail_out);
  inflateEnd(&stream);
  return content;
}

struct Description {
  FileKind kind;
  const char* what;
  const char* how;  ///< to use it
};

constexpr std::array kDescriptions{
    Description{FileKind::world, "a world", "robosim run, serve, check, view, export and bench take it"},
    Description{FileKind::robot_type, "a robot type", "robosim check takes it, and worlds name it in <model>"},
    Description{FileKind::robot_list, "a list of robots", "robosim remote and check take it"},
    Description{FileKind::other_xml, "an XML file of another program", "worlds begin with <world>"},
    Description{FileKind::gridmap, "a map (.gridmap)", "robosim run, serve, check, view, export and arcos take it"},
    Description{FileKind::simple_map, "a map (.simplemap of MRPT)",
                "robosim run, serve, check, view, export and arcos take it"},
    Description{FileKind::octomap, "a map (.bt or .ot of OctoMap)",
                "robosim run, serve, check, view, export and arcos take it"},
    Description{FileKind::ros_yaml, "a map (.yaml of ROS)",
                "robosim run, serve, check, view, export and arcos take it"},
    Description{FileKind::picture, "a picture",
                "a world refers to it, as in <map file=\"plan.png\" resolution=\"0.05\"/>"},
    Description{FileKind::activmedia, "a map (.map)", "robosim run, serve, check, view, export and arcos take it"},
    Description{FileKind::rawlog, "a rawlog, a recording", "robosim replay, view, export and fit take it"},
    Description{FileKind::mcap, "an MCAP recording", "robosim replay, view, export and fit take it"},
    Description{FileKind::sqlite, "an SQLite database, such as a bag of ROS 2",
                "robosim replay, view, export and fit take those of rosbag2"},
    Description{FileKind::bmp, "a picture in the format BMP",
                "a world refers to it, as in <map file=\"plan.bmp\" resolution=\"0.05\"/>"},
    Description{FileKind::jpeg, "a picture in the format JPEG",
                "a world refers to it, as in <map file=\"plan.jpg\" resolution=\"0.05\"/>"},
    Description{FileKind::stage_world, "a world of Stage",
                "robosim run, serve, check, view, export and convert take it"},
    Description{FileKind::carmen_log, "a CARMEN log", "robosim replay, view, export and fit take it"},
    Description{FileKind::scene_3d, "a 3D scene of MRPT", "no command reads it; MRPT's SceneViewer3D does"},
    Description{FileKind::rosbag, "a bag of ROS 1",
                "convert it by rosbags-convert (pip install rosbags), or by MRPT's rosbag2rawlog; robosim replay takes "
                "the result"},
    Description{FileKind::zip, "a ZIP archive, such as an .npz", "no command reads it"},
    Description{FileKind::pdf, "a PDF document", "no command reads it"},
};

const Description& descriptionOf(FileKind kind) {
  return *std::find_if(kDescriptions.begin(), kDescriptions.end(),
                       [kind](const Description& description) { return description.kind == kind; });
}

}  // namespace

FileKind kindOfBytes(std::string_view bytes) {
  struct Signature {
    std::string_view bytes;
    FileKind kind;
  };
  constexpr std::array kSignatures{Signature{"\x89PNG", FileKind::picture},
                                   Signature{"\xff\xd8\xff", FileKind::jpeg},
                                   Signature{"BM", FileKind::bmp},
                                   Signature{"2D-Map", FileKind::activmedia},
                                   Signature{"# Octomap", FileKind::octomap},
                                   Signature{"#ROSBAG", FileKind::rosbag},
                                   Signature{"\x89MCAP0", FileKind::mcap},
                                   Signature{"SQLite format 3", FileKind::sqlite},
                                   Signature{"PK\x03\x04", FileKind::zip},
                                   Signature{"%PDF-", FileKind::pdf}};
  for (const auto& signature : kSignatures) {
    if (bytes.starts_with(signature.bytes)) return signature.kind;
  }
  const bool is_portable = bytes.size() > 2 && bytes[0] == 'P' && bytes[1] >= '1' && bytes[1] <= '6' &&
                           (kSpace.find(bytes[2]) != std::string_view::npos || bytes[2] == '#');
  if (is_portable) return FileKind::picture;
  if (const auto name = mrptClass(bytes); !name.empty()) {
    if (name == "COccupancyGridMap2D") return FileKind::gridmap;
    if (name == "CSimpleMap" || name == "CSensFrameProbSequence") return FileKind::simple_map;
    return name == "COpenGLScene" ? FileKind::scene_3d : FileKind::rawlog;
  }
  if (bytes.starts_with("\xef\xbb\xbf")) bytes.remove_prefix(3);  // byte order mark
  const std::size_t first = bytes.find_first_not_of(kSpace);
  if (first == std::string_view::npos) return FileKind::unknown;
  if (bytes[first] == '<') return kindOfXml(bytes);
  return bytes.find('\0') == std::string_view::npos ? kindOfText(bytes) : FileKind::unknown;
}

FileKind kindOfFile(const std::filesystem::path& file) {
  std::error_code none;
  if (!std::filesystem::is_regular_file(file, none)) return FileKind::unknown;
  std::string beginning(4096, '\0');
  try {
    beginning.resize(InputFile(file).read(beginning.data(), beginning.size()));
  } catch (const std::exception&) {
    return FileKind::unknown;  // whose reader reports this
  }
  return kindOfBytes(beginning.starts_with("\x1f\x8b") ? unpacked(beginning) : beginning);
}

std::string kindText(FileKind kind) {
  if (kind == FileKind::unknown) return "a file of an unknown kind";
  const Description& description = descriptionOf(kind);
  return std::string(description.what) + ": " + description.how;
}

void requireKind(const std::filesystem::path& file, const std::vector<FileKind>& taken) {
  const FileKind kind = kindOfFile(file);
  if (kind == FileKind::unknown || std::find(taken.begin(), taken.end(), kind) != taken.end()) return;
  const bool takes_xml = std::any_of(taken.begin(), taken.end(), [](FileKind one) {
    return one == FileKind::world || one == FileKind::robot_type || one == FileKind::robot_list;
  });
  if (kind == FileKind::other_xml && takes_xml) return;
  throw ConfigError(file.string() + ": is " + kindText(kind));
}

bool isMcapName(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension == ".mcap";
}

}  // namespace robosim
