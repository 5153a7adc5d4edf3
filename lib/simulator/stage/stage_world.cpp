#include "stage/stage_world.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>

#include "base/error_list.h"
#include "base/printable_text.h"
#include "base/xml_element.h"
#include "stage/stage_objects.h"
#include "stage/stage_properties.h"
#include "stage/stage_robot.h"

namespace robosim {
namespace stage {
namespace {

/// Room around everything, and in a world without walls.
constexpr double kMargin_m = 1, kOpenMargin_m = 10;

/// A model of the world with its pose.
struct PlacedModel {
  const Entity* entity;
  Pose world_from_model;
  Size size;
  std::string name;
};

class WorldTranslator {
 public:
  WorldTranslator(const StageFile& parsed, const FileProvider& files)
      : parsed_(parsed), files_(files), units_(Units::of(parsed.world)) {}

  TranslatedStageWorld translate() {
    readWorldSize();
    for (const auto& property : parsed_.assignments) {
      is_planar_ = is_planar_ || (property->name == "pose" && property->values.size() == 3);
    }
    placeChildren(parsed_.world, {}, "");
    root_.name = "world";
    XmlElement surface;
    surface.name = "surface";
    std::vector<mrpt::math::TPoint2D> starts;
    for (const auto& robot : robots_) starts.push_back({robot.world_from_model.plan.x, robot.world_from_model.plan.y});
    const ObjectContext context{&files_, &notes_, &names_, &extent_, std::move(starts)};
    // Robots keep their names, as programs refer to them.
    std::vector<std::string> robot_names;
    for (const auto& robot : robots_) robot_names.push_back(names_.make(robot.name));
    for (const auto& model : models_) {
      addModel(PropertyReader(*model.entity, units_), model.world_from_model, model.size, model.name, context, surface);
    }
    for (std::size_t i = 0; i < robots_.size(); ++i) addRobot(robots_[i], robot_names[i], surface);
    addSize(surface);
    addCommunication();
    root_.children.insert(root_.children.begin(), std::move(surface));
    translated_.text = toXml(root_);
    countProperties();
    translated_.notes = notes_.lines();
    return std::move(translated_);
  }

 private:
  void readWorldSize() {
    const PropertyReader world(parsed_.world, units_);
    const auto size = world.numbers("size", 2);
    if (size.empty()) return;
    for (const double sign : {-0.5, 0.5})
      extent_.include(sign * size[0] * units_.length_m, sign * size[1] * units_.length_m, 0);
  }

  /// @param world_from_top where the children of an entity stand
  void placeChildren(const Entity& parent, const Pose& world_from_top, const std::string& prefix) {
    for (const auto& child : parent.children) {
      if (child.kind == "block" || child.kind == "sensor") continue;
      if (child.kind == "window" || child.kind == "gui") {
        leaveOut(child, "", notes_);
        continue;
      }
      const PropertyReader reader(child, units_);
      PlacedModel model{&child, compose(world_from_top, reader.pose("pose")), {}, {}};
      if (!(std::abs(model.world_from_model.plan.x) <= 1e6 && std::abs(model.world_from_model.plan.y) <= 1e6)) {
        PropertyReader::fail(*reader.find("pose"), "is more than 1,000 km away");
      }
      model.size = reader.size(defaultSize(child.kind));
      if (model.size.x > 1e6 || model.size.y > 1e6 || model.size.z > 1e6) {
        PropertyReader::fail(*reader.find("size"), "is more than 1,000 km");
      }
      model.name = nameOf(reader, prefix);
      readOfAll(reader);
      if (child.kind == "position") {
        robots_.push_back(model);
        continue;
      }
      if (!hasBody(child.kind) && child.kind != "ranger") {
        leaveOut(child, "it is not on a robot", notes_);
        continue;
      }
      if (child.kind == "ranger")
        notes_.add(child.place, "'" + child.type + "' measures nothing, because it is not on a robot");
      controllerOf(reader);
      models_.push_back(model);
      const double top_m = reader.flag("stack_children", true) ? model.size.z : 0;
      placeChildren(child, compose(model.world_from_model, {{}, top_m}), model.name + ".");
    }
  }

  /// Properties of every model, whether they have an effect or not.
  void readOfAll(const PropertyReader& reader) {
    reader.number("update_interval", 0);
    if (reader.number("blob_return", 1) == 0 || reader.number("blobfinder_return", 1) == 0) {
      notes_.add(reader.entity().place,
                 "'" + reader.entity().type + "' is seen by cameras, in spite of its blob_return 0");
    }
  }

  /// The name, or the type with a number as in Stage: "model:0".
  std::string nameOf(const PropertyReader& reader, const std::string& prefix) {
    const Entity& entity = reader.entity();
    std::string name = reader.text("name", "");
    if (name.starts_with("/")) return name.substr(1);
    if (!name.empty()) return prefix + name;
    const std::string& type = entity.type;
    return prefix + type + ":" + std::to_string(numbers_[prefix + type]++);
  }

  void addRobot(const PlacedModel& robot, const std::string& name, XmlElement& surface) {
    const Entity& entity = *robot.entity;
    const PropertyReader reader(entity, units_);
    TranslatedRobot translated = translateRobot(entity, {&units_, &files_, &notes_, is_planar_, robots_.size()});
    for (const double range_m : translated.wifi_ranges_m) wifi_ranges_m_.insert(range_m);
    if (const double z_m = robot.world_from_model.z_m; z_m > 0 && z_m <= 100) {
      for (auto& child : translated.type.children) {
        if (child.name == "body") setNumber(child, "clearance_m", z_m);
      }
    } else if (z_m != 0) {
      notes_.add(reader.entity().place, "'" + entity.type + "' stands on the ground, in spite of its height");
    }
    readVisibility(reader);
    XmlElement& element = surface.add("object").add("shape").add("robot");
    element.add("model", typeOf(entity.type, translated.type));
    element.add("name", name);
    const auto& pose = robot.world_from_model.plan;
    element.add("x", toText(pose.x));
    element.add("y", toText(pose.y));
    if (pose.phi != 0) element.add("direction", toText(pose.phi));
    if (const auto color = colorOf(reader, notes_)) element.add("color", colorText(*color));
    if (const auto controller = controllerOf(reader); !controller.empty()) element.add("controller", controller);
    extent_.include(pose.x, pose.y, std::max(robot.size.x, robot.size.y));
  }

  void readVisibility(const PropertyReader& reader) {
    reader.number("mass", 0);
    reader.number("update_interval", 0);
    const bool is_visible = reader.number("ranger_return", 1) >= 0 && reader.number("laser_return", 1) > 0;
    const bool is_gripped = reader.flag("gripper_return", false);
    if (!reader.flag("obstacle_return", true) || !is_visible || is_gripped) {
      notes_.add(reader.entity().place,
                 "robots are visible obstacles that no gripper holds, in spite of the *_return of '" +
                     reader.entity().type + "'");
    }
  }

  std::string controllerOf(const PropertyReader& reader) {
    std::string controller;
    for (const auto& ctrl : reader.texts("ctrl")) {
      if (ctrl == "wander" || ctrl.starts_with("wander ")) {
        controller = "wander";
      } else {
        notes_.add(reader.find("ctrl")->place,
                   "ctrl \"" + quotable(ctrl) + "\" is left out, because it is a library of Stage");
      }
    }
    return controller;
  }

  /// The name of the robot type with this content: that of the macro, with a number if others have it.
  std::string typeOf(const std::string& macro, XmlElement type) {
    const std::string content = toXmlLine(type);
    if (const auto known = type_names_.find(content); known != type_names_.end()) return known->second;
    std::string base;
    for (const char c : macro)
      base += std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-' ? c : '_';
    const std::string name = types_.make(base);
    type.attributes = {{"name", name}, {"help", "From the Stage model " + base + "."}};
    translated_.robot_types[name] = toXml(type);
    return type_names_[content] = name;
  }

  void addSize(XmlElement& surface) {
    if (extent_.is_empty) extent_.include(0, 0, 0);
    const double margin_m = models_.empty() ? kOpenMargin_m : kMargin_m;
    const auto outward = [](double value) { return std::floor(value * 100 + 0.5) / 100; };
    XmlElement size;
    size.name = "size";
    size.add("xmin", toText(outward(extent_.bounds.x_min - margin_m)));
    size.add("xmax", toText(outward(extent_.bounds.x_max + margin_m)));
    size.add("ymin", toText(outward(extent_.bounds.y_min - margin_m)));
    size.add("ymax", toText(outward(extent_.bounds.y_max + margin_m)));
    surface.children.insert(surface.children.begin(), std::move(size));
  }

  void addCommunication() {
    if (wifi_ranges_m_.empty()) return;
    const double range_m = *wifi_ranges_m_.rbegin();
    if (wifi_ranges_m_.size() > 1) {
      notes_.add(parsed_.world.children.front().place,
                 "all robots have the longest range of their 'wifi', " + toText(range_m) + " m");
    }
    if (range_m > 0) setNumber(root_.add("communication"), "range", range_m);
  }

  void countProperties() { count(parsed_.world, true); }

  /// Counts each property once, and notes those that are ignored.
  void count(const Entity& entity, bool is_world = false) {
    for (const auto& [name, property] : entity.properties) {
      if (!counted_.insert(property.get()).second) continue;
      auto& counts = translated_.properties;
      ++counts.all;
      const PropertyRule* rule = ruleOf(is_world ? "world" : entity.kind, name);
      if (property->is_drawn || (rule && rule->effect == Effect::display)) {
        ++counts.display;
      } else if (property->is_used && (!rule || rule->effect == Effect::translated)) {
        ++counts.translated;
      } else {
        ++counts.ignored;
        if (property->is_noted) continue;
        notes_.ignored(*property, !rule ? "'" + entity.kind + "' has no such property in Stage"
                                  : rule->effect == Effect::ignored ? rule->text
                                                                    : "it has no effect here");
      }
    }
    for (const auto& child : entity.children) count(child);
  }

  const StageFile& parsed_;
  const FileProvider& files_;
  const Units units_;
  Notes notes_;
  UniqueNames names_, types_;
  Extent extent_;
  bool is_planar_ = false;
  std::vector<PlacedModel> models_, robots_;
  std::map<std::string, int> numbers_;
  std::map<std::string, std::string> type_names_;  ///< by content
  std::set<double> wifi_ranges_m_;
  std::set<const Property*> counted_;
  XmlElement root_;
  TranslatedStageWorld translated_;
};

}  // namespace
}  // namespace stage

TranslatedStageWorld translateStageWorld(const std::string& text, const std::string& file, const FileProvider& files) {
  const stage::StageFile parsed = stage::parseStageFile(text, file, files);
  return stage::WorldTranslator(parsed, files).translate();
}

}  // namespace robosim
