#pragma once
#include <array>
#include <optional>
#include <string>

#include "base/xml_element.h"
#include "geometry/shapes/solid.h"
#include "stage/stage_names.h"
#include "stage/stage_reader.h"
#include "stage/stage_shape.h"
#include "world/world.h"

namespace robosim::stage {

/// Extent in plan of what was added.
struct Extent {
  Bounds2D bounds{};
  bool is_empty = true;

  void include(double x, double y, double radius_m);
};

/// The number of a model's fiducial mark; 0 for none, and for an impossible one.
double readFiducial(const PropertyReader& reader, Notes& notes);
/// The colour of a model; nullopt if it has none, a random or an unknown one.
std::optional<std::array<float, 3>> colorOf(const PropertyReader& reader, Notes& notes);
/// As text of an element <color>.
std::string colorText(const std::array<float, 3>& color);

/// What the translation of a model without wheels needs of its world.
struct ObjectContext {
  const FileProvider* files = nullptr;
  Notes* notes = nullptr;
  UniqueNames* names = nullptr;
  Extent* extent = nullptr;
  std::vector<mrpt::math::TPoint2D> robots = {};  ///< where they start: a model around one is hollow
};

/// Adds the body of a model to the elements of a world's <surface>: objects, or a map.
/// @param world_from_model without its `origin`
/// @param size of the model
void addModel(const PropertyReader& reader, const Pose& world_from_model, const Size& size, const std::string& name,
              const ObjectContext& context, XmlElement& surface);

}  // namespace robosim::stage
