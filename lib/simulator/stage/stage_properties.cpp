#include "stage/stage_properties.h"

#include <algorithm>
#include <sstream>
#include <string_view>

namespace robosim::stage {
namespace {

bool matches(std::string_view pattern, const std::string& property) {
  if (pattern.ends_with('*')) return property.starts_with(pattern.substr(0, pattern.size() - 1));
  const std::size_t index = pattern.find("[n]");
  if (index == std::string_view::npos) return pattern == property;
  std::string plain;
  bool is_in_index = false;
  for (const char c : property) {
    if (c == '[') plain += "[n";
    is_in_index = c == '[' || (is_in_index && c != ']');
    if (!is_in_index) plain += c;
  }
  return pattern == plain;
}

bool hasName(const PropertyRule& rule, const std::string& property) {
  std::istringstream names(rule.names);
  for (std::string name; names >> name;) {
    if (matches(name, property)) return true;
  }
  return false;
}

}  // namespace

const std::vector<PropertyRule>& propertyRules() {
  using enum Effect;
  static const std::vector<PropertyRule> rules{
      {"world", "unit_length unit_angle", translated,
       "the units of all numbers; the translation is in metres and radians"},
      {"world", "size", translated, "Stage 2: the surface's `<size>` covers it"},
      {"world", "name interval_sim quit_time resolution", display,
       "options of the command: `--step`, `--time`; ranges are exact, without a raster"},
      {"world",
       "interval_real gui_interval gui_* speedup paused threads show_* laptop host quit_* interval_log threadpool "
       "real_timestep ppm resolution_*",
       display, "Stage's clock, window and threads; `--speed`"},
      {"window", "*", display, "Stage's window"},
      {"block", "points point[n] z", translated,
       "`<cube>`: a rectangle is one, another polygon a thin wall along each edge; scaled to the model's `size`"},
      {"model", "pose origin size stack_children", translated,
       "`<x>`, `<y>`, `<z>`, `<direction>` and the size of the solid"},
      {"model", "name", translated, "`<name>`, made unique"},
      {"model", "color color_rgba", translated, "`<color>`; X11 names; opacity has no effect"},
      {"model", "bitmap", translated, "`<map map_server=\"stage\">`: the dark pixels fill the `size`"},
      {"model", "boundary", translated, "four walls of 1 cm"},
      {"model",
       "noblocks polygons polygon[n].points polygon[n].point[n] polygon[n].z blocks block[n].points "
       "block[n].point[n] block[n].z",
       translated, "as `block`"},
      {"model", "polygon[n].filled", display, "how Stage draws"},
      {"model", "obstacle_return", translated,
       "with an invisible `ranger_return`, 0: no solid; else a solid, which is an obstacle"},
      {"model", "ranger_return laser_return", translated,
       "`<reflectivity>`; invisible and no obstacle: no solid; a solid is always visible"},
      {"model", "gripper_return", translated, "`<movable>`, which a gripper holds and robots push"},
      {"model", "mass", translated, "`mass_kg` of `<movable>`; of others it has no effect, as in Stage"},
      {"model", "ctrl", translated, "`wander` is the controller `wander`; others are libraries of Stage"},
      {"model", "update_interval", translated, "`rate_hz` of lasers and cameras"},
      {"model", "fiducial_return", translated,
       "`<fiducial>` of the model's first solid, or `fiducial` of a robot's body; not of bitmaps"},
      {"model", "fiducial_key", translated, "fiducial sensors see marks of any key"},
      {"model", "blob_return blobfinder_return", translated, "cameras see every solid, also one of 0"},
      {"model", "joules kjoules joules_capacity kjoules_capacity watts", translated,
       "`<battery>` of a robot with both energy and power"},
      {"model", "give_watts take_watts", ignored, "batteries are not charged"},
      {"model", "friction", ignored, "in Stage it has no effect either"},
      {"model",
       "map_resolution filesize alwayson debug event_queue say trail_* gui_* grid nose outline "
       "obstacle_fill thumbnail show_* stall_icon draw_*",
       display, "how Stage draws and updates"},
      {"position", "drive", translated,
       "`<drive type=\"…\"/>`: `diff`, `omni` and `car`; speeds along y are the `lateral_max_mps` of `omni`"},
      {"position", "wheelbase", translated, "`wheelbase_m` of `drive \"car\"`, steered by up to 45°"},
      {"position", "velocity_bounds", translated, "`speed_max_mps`, `turn_max_degps`: the larger of both directions"},
      {"position", "acceleration_bounds", translated,
       "`accel_mps2`, `decel_mps2`, `turn_accel_degps2`; without it speeds change at once, as in Stage"},
      {"position", "max_speed", translated, "as `velocity_bounds`"},
      {"position", "velocity", translated, "robots start at rest"},
      {"position", "localization localization_origin", translated,
       "`<odometry>`, from the start pose; `gps`: without errors"},
      {"position", "odom_error", translated, "`wheelbase_ratio` of the `<odometry>`'s `<noise>` for turns"},
      {"position", "stall_icon", display, "how Stage draws"},
      {"ranger", "scount spose[n] ssize sview", translated, "Stage 2 and 3: as `sensor`"},
      {"ranger", "noise watts_*", ignored, "Stage 4 reads it of a sensor only"},
      {"sensor", "pose size range fov samples", translated,
       "`<laser>` for several samples; for one, a `<sonar model=\"rays\" rays=\"1\">`, since a sonar of Stage is one "
       "ray"},
      {"sensor", "noise", translated,
       "`std_m`, `std_per_m` of a `<laser>`'s or `<sonar>`'s `<noise>`; errors of the angle have no equivalent"},
      {"sensor", "color color_rgba name", display, "how Stage draws"},
      {"sensor", "range_max range_min view", ignored, "Stage 4 reads `range` and `fov` only"},
      {"laser", "samples range_max range_min fov", translated, "`<laser>`"},
      {"laser", "resolution", ignored, "all beams are measured, none is interpolated"},
      {"blobfinder", "colors colors_count image fov pan", translated, "`<camera>` with a `<blob_finder>`, by hue"},
      {"blobfinder", "range range_max", ignored, "cameras have no maximum range"},
      {"fiducial", "range_max range_max_id range_min fov ignore_zloc", translated,
       "`range_max_m`, `id_range_max_m`, `field_of_view_deg` of `<fiducial>`; without `range_min`"},
      {"gripper", "paddle_size", translated, "`opening_m` and `reach_m` of `<gripper>`"},
      {"gripper", "paddle_state autosnatch", ignored, "the controller opens and closes the gripper"},
      {"camera", "resolution fov pantilt", translated,
       "`width_px`, `height_px`, `field_of_view_deg`, `angle_deg`, `tilt_deg` of `<camera>`"},
      {"camera", "range", ignored, "cameras have no maximum range, and see solids beyond 2 cm"},
      {"bumper", "bcount", translated, "`segments` of `<bumper>`, a ring"},
      {"bumper", "bpose[n] blength", ignored, "the segments of a bumper are a ring"},
      {"wifi", "model range", translated, "model `simple`: `range` of the world's `<communication>`"},
      {"wifi", "ip mac essid freq freq_*", ignored, "robots are addressed by their names"},
      {"wifi", "power sensitivity wall_factor range_db plc* link_* random_* itu* *", ignored,
       "`<communication>` has a range and losses in place of signal strengths"},
  };
  return rules;
}

const PropertyRule* ruleOf(const std::string& kind, const std::string& property) {
  const auto find = [&](const std::string& where) -> const PropertyRule* {
    const auto& rules = propertyRules();
    const auto found = std::find_if(rules.begin(), rules.end(), [&](const PropertyRule& rule) {
      return rule.where == where && hasName(rule, property);
    });
    return found == rules.end() ? nullptr : &*found;
  };
  if (const auto* own = find(kind)) return own;
  const bool is_model = kind != "world" && kind != "window" && kind != "block" && kind != "sensor";
  return is_model ? find("model") : nullptr;
}

}  // namespace robosim::stage
