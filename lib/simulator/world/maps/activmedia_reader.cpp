// Reader of ActivMedia's 2D-Map, the format of ARIA and MobileSim: walls as line segments, points scanned by a laser,
// and "cairns", named objects with a position. Units are millimetres and degrees.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <string_view>

#include "base/activmedia_text.h"
#include "base/angle_units.h"
#include "base/portable_math.h"
#include "base/portable_pose.h"
#include "base/printable_text.h"
#include "world/maps/map_formats.h"

namespace robosim {
namespace {

using mrpt::math::TPose2D;

/// Width of the wall that represents a line, which has none: thin enough not to matter to any sensor; ranges are half
/// of it too short. Ends are extended by half of it, so that walls that share a corner are closed.
constexpr double kLineWidth_m = 0.002;
/// Default resolution of points, as in MobileSim.
constexpr double kDefaultResolution_mm = 20;
/// Maximum number of points in a file; several may lie in one cell. Sorting takes 32 bytes per point.
constexpr std::size_t kMaxPoints = 4 * kMaxMapBoxes;

class ActivmediaReader {
 public:
  ActivmediaReader(std::string_view text, const std::string& path) : text_(text, path) {}

  FloorPlan read() {
    using Section = ActivmediaText::Section;
    while (text_.next()) {
      if (text_.section() == Section::metadata) {
        readMetadata(text_.words());
      } else if (text_.section() == Section::lines) {
        const auto at = text_.readLine();
        addLine(at[0], at[1], at[2], at[3]);
      } else {
        if (points_.size() == kMaxPoints) {
          fail("is a point beyond the " + std::to_string(kMaxPoints) + " that a map may have; use fewer");
        }
        points_.push_back(text_.readPoint());
      }
    }
    number_ = text_.number();
    addPoints();
    for (const auto& [number, words] : cairns_) {
      number_ = number;
      readCairn(words);
    }
    for (const auto* starts : {&homes_, &area_homes_, &docks_}) {
      plan_.starts.insert(plan_.starts.end(), starts->begin(), starts->end());
    }
    return std::move(plan_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { text_.fail(what, number_ ? number_ : text_.number()); }

  void readMetadata(const std::vector<std::string>& words) {
    const auto value_at = [&](std::size_t i) { return i < words.size() ? text_.parsed(words[i]) : std::nullopt; };
    if (words[0] == "Resolution:") {
      const auto mm = value_at(1);
      if (!mm || *mm < 0 || *mm > kCellMax_m * 1000) {
        fail("the resolution must be a number in [0, 100000] millimetres; 0 stands for the usual one, 20");
      }
      if (*mm > 0 && *mm < 1) fail("the resolution must be 0 or at least 1 millimetre");
      if (*mm > 0) resolution_mm_ = *mm;
    } else if (words[0] == "OriginLatLongAlt:") {
      readOrigin(words);
    } else if (words[0] == "MapInfo:") {
      readMapInfo(words);
    } else if (words[0] == "Cairn:") {
      cairns_.emplace_back(text_.number(), words);
    }
  }

  /// Reads the position of the map's origin: OriginLatLongAlt: 42.807 -71.58 50
  void readOrigin(const std::vector<std::string>& words) {
    std::array<double, 3> value{};
    constexpr std::array<double, 3> kMax{90, 180, 10'000};
    for (std::size_t i = 0; i < value.size(); ++i) {
      const auto number = i + 1 < words.size() ? text_.parsed(words[i + 1]) : std::nullopt;
      if (!number || !(std::abs(*number) <= kMax[i])) {
        fail(
            "the origin must be a latitude in [-90, 90] and a longitude in [-180, 180] degrees, and an altitude in "
            "[-10000, 10000] metres");
      }
      value[i] = *number;
    }
    plan_.origin = GeoPosition{value[0], value[1], value[2]};
  }

  /// Reads a sector type that is an obstacle: MapInfo: SectorType Name=Box Sim.Obstacle=yes
  void readMapInfo(const std::vector<std::string>& words) {
    std::string name;
    bool is_obstacle = false;
    for (const auto& word : words) {
      if (word.starts_with("Name=")) name = word.substr(5);
      if (isSameWord(word, "Sim.Obstacle=yes")) is_obstacle = true;
    }
    if (words.size() > 1 && words[1] == "SectorType" && is_obstacle) obstacles_.insert(name);
  }

  /// Reads a cairn: Cairn: type x y theta "…" icon "label" [x1 y1 x2 y2]
  void readCairn(const std::vector<std::string>& words) {
    const std::string type = words.size() > 1 ? words[1] : "";
    const bool is_home = type == "RobotHome";
    const bool is_dock = type.starts_with("Dock");
    const bool is_line = type == "Reflector";
    if (!is_home && !is_dock && !is_line && !obstacles_.contains(type)) return;
    if (words.size() < 8) fail("a cairn has a type, x, y, theta, a name, an icon and a label; something is missing");
    const auto number = [&](std::size_t i) {
      const auto value = text_.parsed(words[i]);
      if (!value) fail("'" + quotable(words[i]) + "' of the cairn " + quotable(type) + " is not a number");
      return text_.checked(*value, number_);
    };
    const TPose2D pose{number(2) / 1000, number(3) / 1000, toRadians(number(4))};
    if (words.size() < 12) {
      if (is_home) homes_.push_back(pose);
      if (is_dock) docks_.push_back(pose);
      return;
    }
    const double x1 = number(8), y1 = number(9), x2 = number(10), y2 = number(11);
    if (is_line) {
      addLine(x1, y1, x2, y2);
      return;
    }
    // The corners of an area are given in a frame rotated by theta about the map's origin.
    const TPose2D center = portable::compose(TPose2D(0, 0, pose.phi), TPose2D((x1 + x2) / 2000, (y1 + y2) / 2000, 0));
    if (is_home) {
      area_homes_.push_back(center);
    } else if (is_dock) {
      docks_.push_back(pose);
    } else {
      checkBoxCount();
      plan_.boxes.push_back(
          {center, std::max(kLineWidth_m, std::abs(x2 - x1) / 1000), std::max(kLineWidth_m, std::abs(y2 - y1) / 1000)});
    }
  }

  /// Reports an error if another box would exceed the limit.
  void checkBoxCount() const {
    if (plan_.boxes.size() < kMaxMapBoxes) return;
    fail("is the wall or box beyond the " + std::to_string(kMaxMapBoxes) + " that a map may have; use fewer");
  }

  void addLine(double x1, double y1, double x2, double y2) {
    checkBoxCount();
    const double dx = (x2 - x1) / 1000, dy = (y2 - y1) / 1000;
    plan_.boxes.push_back({{(x1 + x2) / 2000, (y1 + y2) / 2000, dx == 0 && dy == 0 ? 0 : portable::atan2(dy, dx)},
                           portable::hypot(dx, dy) + kLineWidth_m,
                           kLineWidth_m});
  }

  /// Converts the points to cells of a raster that has a cell centred at the origin, as scanned points do.
  void addPoints() {
    if (points_.empty()) return;
    struct Cell {
      std::int64_t row, column;
      auto operator<=>(const Cell&) const = default;  // NOLINT(modernize-use-nullptr): no pointer is here
    };
    std::vector<Cell> cells;
    for (const auto& [x, y] : points_)
      cells.push_back({std::llround(y / resolution_mm_), std::llround(x / resolution_mm_)});
    std::sort(cells.begin(), cells.end());
    cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
    std::int64_t left = std::numeric_limits<std::int64_t>::max(), right = std::numeric_limits<std::int64_t>::min();
    for (const auto& cell : cells) {
      left = std::min(left, cell.column);
      right = std::max(right, cell.column);
    }
    const std::int64_t bottom = cells.front().row;
    plan_.columns = static_cast<std::uint32_t>(right - left + 1);
    plan_.rows = static_cast<std::uint32_t>(cells.back().row - bottom + 1);
    plan_.cell_m = resolution_mm_ / 1000;
    plan_.map_from_grid = {(static_cast<double>(left) - 0.5) * plan_.cell_m,
                           (static_cast<double>(bottom) - 0.5) * plan_.cell_m, 0};
    CellMerger merger;
    for (std::size_t i = 0; i < cells.size();) {
      std::size_t end = i + 1;
      while (end < cells.size() && cells[end].row == cells[i].row && cells[end].column == cells[end - 1].column + 1) {
        ++end;
      }
      merger.add(static_cast<std::uint32_t>(cells[i].row - bottom), static_cast<std::uint32_t>(cells[i].column - left),
                 static_cast<std::uint32_t>(cells[end - 1].column - left + 1));
      i = end;
    }
    plan_.occupied = merger.finish();
  }

  ActivmediaText text_;
  int number_ = 0;  ///< line of what is read after the end of the file; 0 before
  double resolution_mm_ = kDefaultResolution_mm;
  std::set<std::string> obstacles_;  ///< types of cairns that are obstacles
  /// With their line numbers; read last, because a MapInfo line may follow.
  std::vector<std::pair<int, std::vector<std::string>>> cairns_;
  std::vector<std::array<double, 2>> points_;
  std::vector<TPose2D> homes_, area_homes_, docks_;
  FloorPlan plan_;
};

}  // namespace

FloorPlan readActivmediaMap(const std::string& text, const std::string& path) {
  return ActivmediaReader(text, path).read();
}

}  // namespace robosim
