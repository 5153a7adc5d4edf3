#pragma once
#include <cstdint>
#include <vector>

#include "dynamics/group_moment.h"

namespace robosim {

/// The impulses of a part of a step: bodies that touch and approach each other bounce or stop (Pushing, 2).
class Impulses {
 public:
  /// @param island must outlive this object, as group and from must
  /// @param from where the bodies are
  /// @param robots_to where the robots are at the end of the part, after duration_s
  Impulses(const PushingGroup& group, const Island& island, const GroupMoment& from,
           const std::vector<mrpt::math::TPoint2D>& robots_to, double duration_s);

  /// Changes the speeds of objects. Impulses among objects and stationary solids never increase their energy.
  /// @param pushing set to 1 for each pair that has exchanged impulses
  /// @param pushed set to 1 for each object that has got one
  void exchange(std::vector<ObjectMotion>& objects, std::vector<std::uint8_t>& pushing,
                std::vector<std::uint8_t>& pushed);

 private:
  /// A body's part in the contact, with the lever of the middle of the points that touch.
  struct Side {
    Lever at_points, at_middle;
  };
  struct Touch {
    std::uint32_t pair;
    Contact contact;
    Side first, second;
    double impulse_ns[2]{};
    /// Speed of a robot along the normal.
    double robot_mps = 0;
  };

  void findTouches(const Island& island);
  void bounce(std::vector<ObjectMotion>& objects, std::vector<std::uint8_t>& pushing,
              std::vector<std::uint8_t>& pushed) const;
  void stopApproaches(std::vector<ObjectMotion>& objects, std::vector<std::uint8_t>& pushed);
  double separation(const std::vector<ObjectMotion>& objects, const Touch& touch, const Lever& first,
                    const Lever& second, int point) const;
  void apply(const Touch& touch, const Lever& first, const Lever& second, int point, double impulse_ns,
             std::vector<ObjectMotion>& objects, std::vector<std::uint8_t>& pushed) const;
  double restitutionOf(const PushingGroup::Pair& pair) const;

  const PushingGroup& group_;
  const GroupMoment& from_;
  const std::vector<mrpt::math::TPoint2D>& robots_to_;
  double duration_s_;
  std::vector<Touch> touches_;
};

}  // namespace robosim
