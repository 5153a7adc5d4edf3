// Reader of ROS map_server maps: a YAML file that refers to a picture and gives its pose and the meaning of its pixels
// (http://wiki.ros.org/map_server). The settings that map_server requires are required here too; unknown settings are
// ignored, as map_server does.
#include <array>
#include <cmath>

#include <yaml-cpp/yaml.h>

#include "base/error_list.h"
#include "base/input_file.h"
#include "base/printable_text.h"
#include "base/xml_element.h"
#include "base/xml_reader.h"
#include "world/maps/map_formats.h"
#include "world/maps/picture.h"

namespace robosim {
namespace {

/// Maximum size [bytes] of the YAML file, which normally has a few lines.
constexpr std::size_t kMaxYamlBytes = 1u << 20;

class RosMapReader {
 public:
  RosMapReader(const std::string& name, const FileProvider& files) : name_(name), path_(files.pathOf(name)) {
    const std::string text = files.read(name);
    if (text.size() > kMaxYamlBytes) throw ConfigError(path_ + ": is larger than 1 MiB; is it a map's .yaml?");
    try {
      root_ = YAML::Load(text);
    } catch (const YAML::Exception& error) {
      throw ConfigError(path_ + ":" + std::to_string(error.mark.line + 1) + ": this is not YAML: " + error.msg);
    }
    if (!root_.IsMap()) throw ConfigError(path_ + ":1: is not a map_server map; expected image: and other keys");
  }

  OccupancyGrid read(const FileProvider& files, bool is_of_ros1) {
    const std::string image = word("image");
    const double cell_m = number("resolution", {0, kCellMax_m, true}, " metres per pixel");
    const mrpt::math::TPose2D map_from_grid = origin();
    PixelInterpretation pixels;
    pixels.thresholds.are_inclusive = !is_of_ros1;
    pixels.negate = negate();
    pixels.thresholds.occupied = number("occupied_thresh", {0, 1}, "");
    pixels.thresholds.free = number("free_thresh", {0, 1}, "");
    if (pixels.thresholds.free > pixels.thresholds.occupied && errors_.empty()) {
      report(root_["free_thresh"], "free_thresh", "is above occupied_thresh");
    }
    const std::string mode = root_["mode"] ? word("mode") : "trinary";
    if (mode != "trinary" && mode != "scale" && mode != "raw") {
      report(root_["mode"], "mode", "is unknown; accepted are: trinary, scale, raw");
    }
    pixels.is_percent = mode == "raw";
    errors_.throwIfAny();

    const std::string picture = (std::filesystem::path(name_).parent_path() / image).string();
    // ROS 1: in the mode `scale`, alpha marks unknown pixels, which the values between the thresholds do anyway.
    const auto alpha_of_ros1 = mode == "trinary" ? Picture::Alpha::counts : Picture::Alpha::is_left_out;
    const auto alpha = is_of_ros1 ? alpha_of_ros1 : Picture::Alpha::marks_unknown;
    OccupancyGrid grid = gridOf(pictureOf(picture, alpha, files), pixels);
    grid.cell_m = cell_m;
    grid.map_from_grid = map_from_grid;
    return grid;
  }

 private:
  /// Reads the picture; its errors are reported at the line that refers to it.
  Picture pictureOf(const std::string& name, Picture::Alpha alpha, const FileProvider& files) {
    try {
      return readPicture(files.read(name), files.pathOf(name), alpha);
    } catch (const ConfigError& error) {
      report(root_["image"], "image", withoutImage(error.what(), files.pathOf(name)) + besideText(name, files));
      errors_.throwIfAny();
      throw;
    }
  }

  /// An absolute path is that of the error already.
  std::string withoutImage(const std::string& error, const std::string& path) {
    const bool is_same = path == root_["image"].Scalar() && error.starts_with(path + ": ");
    return is_same ? error.substr(path.size() + 2) : error;
  }

  /// For a picture whose path is that of another computer, and that lies beside the file.
  std::string besideText(const std::string& name, const FileProvider& files) {
    const std::filesystem::path picture = std::filesystem::path(name).filename();
    const std::filesystem::path beside = std::filesystem::path(path_).parent_path() / picture;
    std::error_code none;
    if (std::filesystem::exists(files.pathOf(name), none) || !std::filesystem::exists(beside, none)) return "";
    return "; " + picture.string() + " lies beside this file: write image: " + picture.string();
  }

  void report(const YAML::Node& node, const std::string& key, const std::string& what) {
    std::string quoted = key + ": ";
    if (node.IsScalar() && !node.Scalar().empty()) quoted += quotable(node.Scalar()) + ": ";
    errors_.add(path_, node.Mark().line + 1, quoted + what);
  }

  /// The scalar under a key; reports an error and returns an invalid node when there is none.
  YAML::Node scalar(const std::string& key) {
    const YAML::Node node = root_[key];
    if (!node) {
      errors_.add(path_, 1, key + ": is missing; add it");
    } else if (!node.IsScalar()) {
      report(node, key, "is not a single value");
    } else {
      return node;
    }
    return YAML::Node(YAML::NodeType::Undefined);
  }

  std::string word(const std::string& key) {
    const YAML::Node node = scalar(key);
    if (!node.IsScalar()) return "";
    if (node.Scalar().empty()) report(node, key, "is empty; give a value");
    return node.Scalar();
  }

  double number(const std::string& key, const Bounds& bounds, const std::string& unit) {
    const YAML::Node node = scalar(key);
    return node.IsScalar() ? number(node, key, bounds, unit) : bounds.max;
  }

  double number(const YAML::Node& node, const std::string& key, const Bounds& bounds, const std::string& unit) {
    const auto value = node.IsScalar() ? parseNumber(node.Scalar()) : std::nullopt;
    if (value && std::isfinite(*value) && bounds.contain(*value)) return *value;
    report(node, key,
           std::string("must be a number in ") + (bounds.min_is_open ? "(" : "[") + toText(bounds.min) + ", " +
               toText(bounds.max) + "]" + unit);
    return bounds.max;
  }

  bool negate() {
    const YAML::Node node = scalar("negate");
    if (!node.IsScalar()) return false;
    const std::string& text = node.Scalar();
    if (text == "1" || text == "true" || text == "True") return true;
    if (text != "0" && text != "false" && text != "False") report(node, "negate", "must be 0 or 1");
    return false;
  }

  mrpt::math::TPose2D origin() {
    const YAML::Node node = root_["origin"];
    if (!node) {
      errors_.add(path_, 1, "origin: is missing; add it");
    } else if (!node.IsSequence() || node.size() != 3) {
      report(node, "origin", "must be [x, y, yaw], in metres and radians");
    } else {
      std::array<double, 3> values{};
      for (std::size_t i = 0; i < 3; ++i) {
        values[i] = number(node[i], "origin", {-kMapReach_m, kMapReach_m}, i < 2 ? " metres" : " radians");
      }
      return {values[0], values[1], values[2]};
    }
    return {};
  }

  std::string name_, path_;
  YAML::Node root_;
  ErrorList errors_;
};

}  // namespace

std::filesystem::path pictureOfRosMap(const std::filesystem::path& yaml) {
  try {
    const YAML::Node image = YAML::Load(readWholeFile(yaml, kMaxYamlBytes, ""))["image"];
    if (image && image.IsScalar()) return yaml.parent_path() / image.Scalar();
  } catch (const std::exception&) {
    // Reported when the map is read.
  }
  return {};
}

OccupancyGrid readRosMap(const std::string& name, const FileProvider& files, const MapReading& reading) {
  return RosMapReader(name, files).read(files, reading.is_of_ros1);
}

}  // namespace robosim
