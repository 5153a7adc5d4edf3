#include "rendering/robot_mesh.h"

#include <algorithm>
#include <cmath>

namespace robosim {
namespace {

using mrpt::math::TPoint2D;
using mrpt::math::TPoint3D;
using mrpt::math::TPose3D;

constexpr Material kPaint{.color = {1, 1, 1}, .gloss = 0.2f, .painted = true};
constexpr Material kShadedPaint{.color = {0.82f, 0.82f, 0.82f}, .gloss = 0.1f, .painted = true};
constexpr Material kRubber{.color = {0.10f, 0.10f, 0.11f}};
constexpr Material kPlastic{.color = {0.17f, 0.18f, 0.20f}, .gloss = 0.15f};
constexpr Material kHub{.color = {0.62f, 0.64f, 0.66f}, .gloss = 0.35f};
constexpr Material kBronze{.color = {0.78f, 0.58f, 0.26f}, .gloss = 0.3f};
constexpr Material kGlass{.color = {0.05f, 0.07f, 0.12f}, .gloss = 0.7f};
constexpr Material kMark{.color = {0.95f, 0.94f, 0.88f}};
constexpr Material kScanner{.color = {0.33f, 0.50f, 0.68f}, .gloss = 0.15f};

/// Radius of a Pioneer's disc; part sizes are relative to it.
constexpr double kPioneerRadius_m = 0.267;

/// Builds the mesh of one robot. Horizontal coordinates are in units of the body's half length and half width, vertical
/// ones in units of its height.
class RobotBuilder {
 public:
  RobotBuilder(const RobotModel& model, const Body& body, Detail detail)
      : model_(model), detail_(detail), full_(detail == Detail::full) {
    const auto* box = std::get_if<Cube>(&body.shape);
    half_length_m_ = box ? box->length_m / 2 : std::get<Cylinder>(body.shape).radius_m;
    half_width_m_ = box ? box->width_m / 2 : half_length_m_;
    height_m_ = body.height_m;
    clearance_m_ = std::max(0.0, body.heights().z_min_m);
    size_ = std::min(half_length_m_, half_width_m_) / kPioneerRadius_m;
    has_deck_ = box || model.look == BodyLook::deck;
  }

  Mesh build() {
    if (detail_ == Detail::speck) {
      const double x_m = 0.8 * half_length_m_, y_m = 0.7 * half_width_m_;
      prism({{x_m, -y_m}, {x_m, y_m}, {-x_m, y_m}, {-x_m, -y_m}}, 0, 1, kPaint, kShadedPaint);
      return mesh_;
    }
    if (detail_ == Detail::tiny) {
      prism(hull(has_deck_ ? 1 : 1.4), 0, 1, kPaint, kShadedPaint);
      addArrow(has_deck_ ? 0.42 : 0, 0.3);
      return mesh_;
    }
    if (has_deck_) {
      buildDeck();
    } else {
      buildDrum();
    }
    for (const auto& sensor : model_.sensors) addSensor(sensor->info());
    Mesh standing;
    standing.add(mesh_, {0, 0, clearance_m_, 0, 0, 0});
    return standing;
  }

 private:
  /// Height of the sonar ring, as a fraction of the body's height.
  double sonarHeight() const {
    for (const auto& sensor : model_.sensors) {
      const SensorInfo& info = sensor->info();
      if (info.kind == SensorKind::sonar && !info.beams.empty()) {
        return std::clamp(info.beams[0].robot_from_beam.z / height_m_, 0.42, 0.8);
      }
    }
    return 0.68;
  }

  /// A body like a Pioneer's: a hull on two wheels and a caster, with a flat deck.
  void buildDeck() {
    const double band = sonarHeight();
    const double wheel_m = std::min(0.365 * half_length_m_, 0.43 * height_m_);
    addWheels(wheel_m, 0.62, 0.16);
    addCaster(-0.72);
    prism(hull(1), 0.26, band - 0.12, kPaint, {});
    prism(hull(1.02), band - 0.12, band + 0.12, kPlastic, kPlastic);
    prism(hull(1), band + 0.12, 0.95, kPaint, {});
    prism(hull(1.05), 0.95, 1, kPlastic, kPlastic);
    addArrow(0.42, 0.10);
    prismAt(0.60, 0, 0.055, 0.10, 0.30, band - 0.16, kMark);
  }

  /// A body like a Nomad Scout's: an upright drum.
  void buildDrum() {
    const double band = sonarHeight();
    addWheels(std::min(0.4 * half_length_m_, 0.3 * height_m_), 0.72, 0.14);
    cone(0.14, 0.17, 0.90, 0.99, kRubber, {});
    cone(0.17, 0.27, 0.99, 0.99, kRubber, kRubber);
    cone(0.27, band - 0.10, 0.95, 0.95, kPaint, {});
    cone(band - 0.10, band + 0.10, 0.97, 0.97, kPlastic, kPlastic);
    cone(band + 0.10, 0.96, 0.95, 0.95, kPaint, {});
    cone(0.96, 1, 0.95, 0.86, kPaint, kShadedPaint);
    addArrow(0.0, 0.30);
    prismAt(0.93, 0, 0.035, 0.10, 0.31, band - 0.14, kMark);
  }

  /// A Pioneer's outline: one side for each sonar; the four sides at the nose and the four at the tail have half
  /// length.
  std::vector<TPoint2D> hull(double wider) const {
    static const std::vector<TPoint2D> fine{{0.648, 0},     {0.612, 0.199},  {0.493, 0.406}, {0.369, 0.51},
                                            {-0.683, 0.51}, {-0.836, 0.382}, {-0.935, 0.21}, {-0.973, 0}};
    static const std::vector<TPoint2D> rough{{0.64, 0.1}, {0.37, 0.51}, {-0.68, 0.51}, {-0.96, 0.1}};
    const auto& left = full_ ? fine : rough;
    std::vector<TPoint2D> outline;
    for (const auto& p : left) outline.emplace_back(wider * p.x * half_length_m_, wider * p.y * half_width_m_);
    for (auto p = left.rbegin(); p != left.rend(); ++p) {
      if (p->y > 0) outline.emplace_back(wider * p->x * half_length_m_, -wider * p->y * half_width_m_);
    }
    return outline;
  }

  void prism(const std::vector<TPoint2D>& outline, double low, double high, const Material& side,
             const std::optional<Material>& top) {
    addPrism(mesh_, outline, low * height_m_, high * height_m_, side, top);
  }

  /// A box centred at a horizontal position.
  void prismAt(double x, double y, double half_length, double half_width, double low, double high, const Material& f) {
    addBox(mesh_, {(x - half_length) * half_length_m_, (y - half_width) * half_width_m_, low * height_m_},
           {(x + half_length) * half_length_m_, (y + half_width) * half_width_m_, high * height_m_}, f);
  }

  void cone(double low, double high, double radius_low, double radius_high, const Material& side,
            const std::optional<Material>& top) {
    addCone(mesh_,
            {.axis = {},
             .z_low_m = low * height_m_,
             .z_high_m = high * height_m_,
             .radius_low_m = radius_low * half_length_m_,
             .radius_high_m = radius_high * half_length_m_,
             .sides = full_ ? 40 : 10},
            side, top);
  }

  void addWheels(double radius_m, double y, double width) {
    const double half_m = width / 2 * half_width_m_;
    Mesh wheel;  // axis vertical, inner side down
    addCone(wheel, {{}, 0, 2 * half_m, radius_m, radius_m, full_ ? 28 : 6}, kRubber, kRubber);
    if (full_) addCone(wheel, {{}, 2 * half_m, 2.1 * half_m, 0.62 * radius_m, 0.5 * radius_m, 20}, kHub, kHub);
    // The axle height equals the wheel radius.
    const double z_m = radius_m - clearance_m_;
    mesh_.add(wheel, {0, y * half_width_m_ - half_m, z_m, 0, 0, -M_PI / 2});
    mesh_.add(wheel, {0, -y * half_width_m_ + half_m, z_m, 0, 0, M_PI / 2});
  }

  void addCaster(double x) {
    if (!full_) return;
    const double radius_m = 0.14 * half_length_m_;
    Mesh wheel;
    addCone(wheel, {{}, 0, 0.1 * half_length_m_, radius_m, radius_m, 16}, kRubber, kRubber);
    const double z_m = radius_m - clearance_m_;
    mesh_.add(wheel, {x * half_length_m_, -0.05 * half_length_m_, z_m, 0, 0, -M_PI / 2});
    mesh_.add(wheel, {x * half_length_m_, 0.05 * half_length_m_, z_m, 0, 0, M_PI / 2});
  }

  /// A heading mark, visible from above.
  void addArrow(double x, double size) {
    const double z_m = height_m_ * 1.004;
    const double tip_m = (x + 1.6 * size) * half_length_m_, back_m = (x - size) * half_length_m_,
                 half_m = size * half_width_m_;
    const TPoint3D left[] = {{tip_m, 0, z_m}, {back_m, half_m, z_m}, {back_m + half_m * 0.6, 0, z_m}};
    const TPoint3D right[] = {{tip_m, 0, z_m}, {back_m + half_m * 0.6, 0, z_m}, {back_m, -half_m, z_m}};
    addPolygon(mesh_, left, kMark);
    addPolygon(mesh_, right, kMark);
  }

  void addSensor(const SensorInfo& info) {
    switch (info.kind) {
      case SensorKind::sonar:
        if (full_) {
          for (const auto& beam : info.beams) addSonar(beam.robot_from_beam);
        }
        break;
      case SensorKind::laser:
        if (!info.beams.empty()) addLaser(info);
        break;
      case SensorKind::camera:
        addCamera(info.beams[0].robot_from_beam);
        break;
      default:
        break;  // too small to be visible
    }
  }

  /// A transducer: a bronze disc in a black rim, just outside the band that carries it.
  void addSonar(const TPose3D& at) {
    Mesh lying;
    const double radius_m = 0.021 * size_;
    addCone(lying, {{}, -0.012 * size_, 0.006 * size_, radius_m * 1.25, radius_m * 1.2, 14}, kRubber, kRubber);
    addDisc(lying, {}, 0.0065 * size_, radius_m, 14, kBronze);
    TPose3D place = at;
    if (!has_deck_) {
      const double angle_rad = std::hypot(at.x, at.y) > 1e-9 ? std::atan2(at.y, at.x) : at.yaw;
      place.x = 0.97 * half_length_m_ * std::cos(angle_rad);
      place.y = 0.97 * half_length_m_ * std::sin(angle_rad);
    }
    place.z = sonarHeight() * height_m_;
    place.pitch = M_PI / 2;  // from facing up to facing forward
    mesh_.add(lying, place);
  }

  /// A SICK scanner on the deck; a little turret for a single beam.
  void addLaser(const SensorInfo& info) {
    const TPose3D& middle = info.beams[info.beams.size() / 2].robot_from_beam;
    const double s = size_, z_m = height_m_;
    Mesh device;
    if (info.beams.size() == 1) {
      addCone(device, {{}, 0, 0.05 * s, 0.045 * s, 0.035 * s, full_ ? 20 : 6}, kPlastic, kPlastic);
      if (full_) addBox(device, {0.02 * s, -0.01 * s, 0.015 * s}, {0.045 * s, 0.01 * s, 0.035 * s}, kGlass);
      mesh_.add(device, {0, 0, z_m, middle.yaw, 0, 0});
      return;
    }
    addBox(device, {-0.078 * s, -0.078 * s, 0}, {0.02 * s, 0.078 * s, 0.185 * s}, kScanner);
    addBox(device, {0.02 * s, -0.078 * s, 0}, {0.078 * s, 0.078 * s, 0.07 * s}, kScanner);
    addCone(device, {{0.012 * s, 0}, 0.07 * s, 0.125 * s, 0.06 * s, 0.06 * s, full_ ? 28 : 8}, kGlass, kGlass);
    addCone(device, {{0.012 * s, 0}, 0.125 * s, 0.185 * s, 0.066 * s, 0.066 * s, full_ ? 28 : 8}, kScanner, kScanner);
    mesh_.add(device, {middle.x, middle.y, z_m, middle.yaw, 0, 0});
  }

  /// A small camera behind its optical centre, on a post where that is above the deck.
  void addCamera(const TPose3D& eye) {
    const double s = std::min(1.0, size_);
    Mesh camera;
    addBox(camera, {-0.075 * s, -0.03 * s, -0.026 * s}, {-0.012 * s, 0.03 * s, 0.026 * s}, kPlastic);
    Mesh lens;
    addCone(lens, {{}, 0, 0.008 * s, 0.019 * s, 0.017 * s, full_ ? 20 : 6}, kHub, kGlass);
    camera.add(lens, {-0.012 * s, 0, 0, 0, M_PI / 2, 0});
    mesh_.add(camera, eye);
    if (eye.z <= height_m_) return;
    const double back_m = 0.045 * s;
    const TPoint2D foot(eye.x - back_m * std::cos(eye.yaw), eye.y - back_m * std::sin(eye.yaw));
    addCone(mesh_, {foot, height_m_, eye.z - 0.02 * s, 0.012 * s, 0.012 * s, full_ ? 12 : 4}, kHub, {});
  }

  const RobotModel& model_;
  const Detail detail_;
  const bool full_;
  bool has_deck_ = false;
  double half_length_m_ = 0, half_width_m_ = 0;  ///< half of its length and width
  double height_m_ = 0, clearance_m_ = 0;
  double size_ = 1;  ///< relative to a Pioneer
  Mesh mesh_;        ///< robot frame
};

}  // namespace

Mesh robotMesh(const RobotModel& model, const Body& body, Detail detail) {
  return RobotBuilder(model, body, detail).build();
}

}  // namespace robosim
