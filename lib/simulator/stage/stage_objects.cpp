#include "stage/stage_objects.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/portable_math.h"
#include "base/portable_pose.h"
#include "base/printable_text.h"
#include "stage/stage_colors.h"
#include "stage/stage_robot.h"

namespace robosim::stage {
namespace {

using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

/// Most objects that a picture without a <map> may become.
constexpr std::size_t kBitmapObjectsMax = 50'000;

void setPlace(XmlElement& element, const TPose2D& pose) {
  element.add("x", toText(pose.x));
  element.add("y", toText(pose.y));
  if (pose.phi != 0) element.add("direction", toText(pose.phi));
}

class ModelTranslator {
 public:
  ModelTranslator(const PropertyReader& reader, const Pose& world_from_model, const Size& size, const std::string& name,
                  const ObjectContext& context, XmlElement& surface)
      : reader_(reader), size_(size), name_(name), context_(context), surface_(surface) {
    world_from_body_ = compose(world_from_model, reader.pose("origin"));
  }

  void translate() {
    translateSolid();
    if (fiducial_ != 0) {
      context_.notes->ignored(*reader_.find("fiducial_return"),
                              "the model is no solid of its own, which could be marked");
    }
  }

 private:
  void translateSolid() {
    shape_ = readShape(reader_, size_, hasBody(reader_.entity().kind), *context_.files, *context_.notes);
    color_ = colorOf(reader_, *context_.notes).value_or(std::array<float, 3>{1, 0, 0});
    const bool is_movable = reader_.flag("gripper_return", false);
    mass_kg_ = reader_.number("mass", 10);
    fiducial_ = readFiducial(reader_, *context_.notes);
    if (shape_.prisms.empty() && !shape_.bitmap) return;
    if (!readVisibility(is_movable)) return;
    if (!(size_.z > 0)) {
      note("has no height, and is left out");
      return;
    }
    if (is_movable && world_from_body_.z_m == 0 && size_.x > 0 && size_.y > 0) {
      addMovable();
      return;
    }
    for (const auto& prism : shape_.prisms) addPrism(prism);
    if (shape_.bitmap) addBitmap(*shape_.bitmap);
  }

  void note(const std::string& text) {
    context_.notes->add(reader_.entity().place, "'" + reader_.entity().type + "' " + text);
  }

  /// @return whether the model is a solid
  bool readVisibility(bool is_movable) {
    const double reflectance = reader_.number("ranger_return", 1);
    const double of_laser = reader_.number("laser_return", 1);
    const bool is_visible = reflectance >= 0 && (of_laser > 0 || reader_.has("ranger_return"));
    const bool is_obstacle = reader_.flag("obstacle_return", true);
    if (reader_.has("ranger_return") && reflectance >= 0) reflectivity_ = std::min(reflectance, 1.0);
    if (of_laser >= 2) reflectivity_ = 1;
    if (is_movable || (is_visible && is_obstacle)) return true;
    if (!is_visible && !is_obstacle) return false;
    // A Stage floor plan is often no obstacle, so that its map is drawn only for the sensors.
    note(is_visible ? "is an obstacle as well as visible, in spite of its obstacle_return 0"
                    : "is visible as well as an obstacle, in spite of its ranger_return or laser_return");
    return true;
  }

  /// The model as one box or cylinder, which is pushed and gripped as a whole.
  void addMovable() {
    const auto& prisms = shape_.prisms;
    const bool is_round = prisms.size() == 1 && prisms[0].outline.size() >= 8 && size_.x == size_.y;
    XmlElement& solid = addSolid(is_round ? "cylinder" : "cube", name_, world_from_body_.plan, {0, size_.z});
    if (is_round) {
      solid.add("radius", toText(size_.x / 2));
    } else {
      solid.add("length", toText(size_.x));
      solid.add("width", toText(size_.y));
      if (shape_.bitmap || prisms.size() > 1 || !rectangleOf(prisms[0].outline))
        note("is movable as a box of its size");
    }
    XmlElement& movable = solid.add("movable");
    setNumber(movable, "mass_kg", std::clamp(mass_kg_, 1e-3, 1e6));
    extend(world_from_body_.plan, size_.x, size_.y);
  }

  void addPrism(const Prism& prism) {
    const auto rectangle = rectangleOf(prism.outline);
    const bool is_around_robot =
        std::any_of(context_.robots.begin(), context_.robots.end(), [&](const TPoint2D& robot) {
          const TPose2D at = portable::relative(world_from_body_.plan, {robot.x, robot.y, 0});
          return contains(prism.outline, {at.x, at.y});
        });
    if (rectangle && !is_around_robot) {
      addBox(*rectangle, prism.heights);
      return;
    }
    for (const auto& edge : edgesOf(prism.outline)) addBox(edge, prism.heights);
  }

  void addBox(const Rectangle& box, HeightSpan heights) {
    heights.z_min_m += world_from_body_.z_m;
    heights.z_max_m += world_from_body_.z_m;
    if (!(box.length_m > 0 && box.width_m > 0 && heights.z_max_m > heights.z_min_m)) return;
    const TPose2D pose = portable::compose(world_from_body_.plan, box.body_from_center);
    XmlElement& cube = addSolid("cube", name_, pose, heights);
    cube.add("length", toText(box.length_m));
    cube.add("width", toText(box.width_m));
    extend(pose, box.length_m, box.width_m);
  }

  void addBitmap(const Bitmap& bitmap) {
    const auto& corner = bitmap.body_from_corner;
    extend(world_from_body_.plan, size_.x, size_.y);
    if (world_from_body_.z_m == 0) {
      const TPoint2D at = portable::compose(world_from_body_.plan, corner);
      XmlElement& map = surface_.add("map");
      map.add("file", bitmap.file);
      map.add("map_server", "stage");
      map.add("resolution", toText(bitmap.pixel_x_m));
      if (std::abs(bitmap.pixel_y_m / bitmap.pixel_x_m - 1) > 1e-9) map.add("resolution_y", toText(bitmap.pixel_y_m));
      setPlace(map, {at.x, at.y, world_from_body_.plan.phi});
      map.add("height", toText(size_.z));
      map.add("color", colorText(color_));
      return;
    }
    // Maps begin at the floor.
    if (bitmap.plan.occupied.size() > kBitmapObjectsMax) {
      note("is left out, because its bitmap is not at the floor, and makes more than 50,000 boxes");
      return;
    }
    for (const auto& cells : bitmap.plan.occupied) {
      Rectangle box;
      box.body_from_center = {corner.x + (cells.column + cells.columns / 2.0) * bitmap.pixel_x_m,
                              corner.y + (cells.row + cells.rows / 2.0) * bitmap.pixel_y_m, 0};
      box.length_m = cells.columns * bitmap.pixel_x_m;
      box.width_m = cells.rows * bitmap.pixel_y_m;
      addBox(box, {0, size_.z});
    }
  }

  XmlElement& addSolid(const char* kind, const std::string& name, const TPose2D& pose, const HeightSpan& heights) {
    XmlElement& solid = surface_.add("object").add("shape").add("primitive").add(kind);
    solid.add("name", context_.names->make(name));
    setPlace(solid, pose);
    solid.add("z", toText((heights.z_min_m + heights.z_max_m) / 2));
    solid.add("height", toText(heights.z_max_m - heights.z_min_m));
    solid.add("color", colorText(color_));
    if (reflectivity_) solid.add("reflectivity", toText(*reflectivity_));
    if (const double mark = std::exchange(fiducial_, 0); mark != 0) solid.add("fiducial", toText(mark));
    return solid;
  }

  void extend(const TPose2D& pose, double length_m, double width_m) {
    for (const double x : {-length_m / 2, length_m / 2}) {
      for (const double y : {-width_m / 2, width_m / 2}) {
        const TPoint2D corner = portable::compose(pose, TPoint2D(x, y));
        context_.extent->include(corner.x, corner.y, 0);
      }
    }
  }

  const PropertyReader& reader_;
  const Size size_;
  const std::string& name_;
  const ObjectContext& context_;
  XmlElement& surface_;
  Pose world_from_body_;
  Shape shape_;
  std::array<float, 3> color_{};
  double mass_kg_ = 1;
  double fiducial_ = 0;  ///< of the first solid
  std::optional<double> reflectivity_;
};

}  // namespace

double readFiducial(const PropertyReader& reader, Notes& notes) {
  const double number = reader.number("fiducial_return", 0);
  if (reader.number("fiducial_key", 0) != 0)
    notes.add(reader.find("fiducial_key")->place, "fiducial sensors see marks of any fiducial_key");
  if (number >= 0 && number <= 65535 && number == std::floor(number)) return number;
  notes.add(reader.find("fiducial_return")->place, "a fiducial_return is a whole number up to 65,535, and is left out");
  return 0;
}

void Extent::include(double x, double y, double radius_m) {
  const Bounds2D around{x - radius_m, x + radius_m, y - radius_m, y + radius_m};
  bounds = is_empty ? around
                    : Bounds2D{std::min(bounds.x_min, around.x_min), std::max(bounds.x_max, around.x_max),
                               std::min(bounds.y_min, around.y_min), std::max(bounds.y_max, around.y_max)};
  is_empty = false;
}

std::optional<std::array<float, 3>> colorOf(const PropertyReader& reader, Notes& notes) {
  if (const auto rgb = reader.numbers("color_rgba", 3); !rgb.empty()) {
    std::array<float, 3> color{};
    for (std::size_t i = 0; i < 3; ++i) color[i] = static_cast<float>(std::clamp(rgb[i], 0.0, 1.0));
    return color;
  }
  const Property* property = reader.find("color");
  if (!property) return std::nullopt;
  const std::string name = reader.text("color", "");
  if (name == "random") return std::nullopt;
  const auto color = colorNamed(name);
  if (!color) notes.add(property->place, "the colour \"" + quotable(name) + "\" is not known, and left out");
  return color;
}

std::string colorText(const std::array<float, 3>& color) {
  std::string text;
  for (const float channel : color) text += (text.empty() ? "" : " ") + toText(std::floor(channel * 1000 + 0.5) / 1000);
  return text;
}

void addModel(const PropertyReader& reader, const Pose& world_from_model, const Size& size, const std::string& name,
              const ObjectContext& context, XmlElement& surface) {
  ModelTranslator(reader, world_from_model, size, name, context, surface).translate();
}

}  // namespace robosim::stage
