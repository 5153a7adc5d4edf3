#pragma once
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <mrpt/math/TPose2D.h>

#include "base/error_list.h"
#include "stage/stage_file.h"

namespace robosim::stage {

/// Pose of a model or its body: in plan, and height of its underside.
struct Pose {
  mrpt::math::TPose2D plan;  ///< [m, rad]
  double z_m = 0;
};
/// a_from_c
Pose compose(const Pose& a_from_b, const Pose& b_from_c);

/// Extent of a model [m].
struct Size {
  double x = 0.4, y = 0.4, z = 1;
};

/// Units of a world file.
struct Units {
  double length_m = 1;
  double angle_rad = 0;

  /// From `unit_length` and `unit_angle` of the file. @throws ConfigError for an unknown unit
  static Units of(const Entity& world);
};

/// Notes about what the translation leaves out or changes, each once per file with the number of its lines.
class Notes {
 public:
  /// `what` is left out or changed, for a `reason`: "drive \"omni\" is driven as differential".
  void add(const Place& place, const std::string& text);
  /// A property that the translation does not use.
  void ignored(const Property& property, const std::string& reason);
  /// "pioneer.inc:12: gui_x is ignored, because …; 3 lines more", in the order in which they were added.
  std::vector<std::string> lines() const;

 private:
  struct Note {
    Place first;
    std::string text;
    std::set<int> at;  ///< lines
  };
  std::vector<Note> notes_;
  std::map<std::pair<std::string, std::string>, std::size_t> index_;  ///< by file and text
};

/// Reads the properties of an entity, and marks them as used. All lengths are in metres, all angles in radians.
class PropertyReader {
 public:
  PropertyReader(const Entity& entity, const Units& units) : entity_(&entity), units_(&units) {}

  const Entity& entity() const { return *entity_; }
  /// The property, marked as used; null if the entity has none of this name.
  const Property* find(const std::string& name) const;
  bool has(const std::string& name) const { return entity_->properties.count(name) > 0; }
  /// @name Values; `otherwise` if there is none @throws ConfigError "file:line: what"
  ///@{
  double number(const std::string& name, double otherwise) const;
  double length(const std::string& name, double otherwise_m) const;
  double angle(const std::string& name, double otherwise_rad) const;
  bool flag(const std::string& name, bool otherwise) const { return number(name, otherwise ? 1 : 0) != 0; }
  std::string text(const std::string& name, const std::string& otherwise) const;
  std::vector<std::string> texts(const std::string& name) const;
  /// The numbers of a tuple, without conversion; empty if there is none.
  /// @param least smallest number of them
  std::vector<double> numbers(const std::string& name, std::size_t least) const;
  /// [x y z angle], or [x y angle] of Stage 2.
  Pose pose(const std::string& name) const;
  /// [x y z], or [x y] of Stage 2. @throws also for a size that is not positive
  Size size(const Size& otherwise) const;
  ///@}
  double lengthUnit_m() const { return units_->length_m; }
  double angleUnit_rad() const { return units_->angle_rad; }
  const Units& units() const { return *units_; }

  /// @throws ConfigError "file:line: 'name' what"
  [[noreturn]] static void fail(const Property& property, const std::string& what);

 private:
  const Property* one(const std::string& name, TokenKind kind, const char* what) const;

  const Entity* entity_;
  const Units* units_;
};

}  // namespace robosim::stage
