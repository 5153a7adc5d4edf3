#pragma once
#include <mrpt/math/TPoint2D.h>
#include <mrpt/math/TPose2D.h>

#include "geometry/solid.h"

namespace robosim {

/// Gap [m] that a clipped move leaves before the contact, so that rounding never makes two bodies overlap.
constexpr double kContactGap_m = 1e-6;

/// The way of a disc's centre through one time step: an arc of constant curvature, taken as a chain of chords whose
/// ends lie on the arc (at most 3° of turn each, so the chord leaves an arc of 1 m radius by less than 0.4 mm). The
/// chords are what the robot drives: queries on them are exact. Fractions run over the whole step, 0 … 1, in time and
/// length alike.
struct Path {
  mrpt::math::TPose2D world_from_start;
  double length_m = 0;      ///< signed: negative backwards
  double turn_rad = 0;      ///< signed, CCW
  double end_fraction = 1;  ///< the centre stops there; the turn goes on to its end

  int chords() const;
  /// Where the centre is at a fraction of the step; beyond end_fraction it stays.
  mrpt::math::TPoint2D centerAt(double fraction) const;
  /// Pose at the end of the step: the centre where it stopped, the heading fully turned, within (-π, π].
  mrpt::math::TPose2D endPose() const;
  double clippedLength() const { return length_m * end_fraction; }  ///< signed [m]
};

/// The fraction in [0, 1] at which a disc on the path first comes within kContactGap_m of the outline; 1 when it never
/// does. A disc that starts that near is free to leave or to slide along, and stopped (0) if it would come nearer.
/// Looks at no more than the path up to its end_fraction.
double firstContact(const Path&, double radius_m, const Outline&);

/// The fraction in [0, 1] at which a disc on the path first comes within kContactGap_m of the edge of `area` from
/// inside; 1 when it never does. A disc that starts beyond that is free to come back, and stopped (0) if it would go
/// further out.
double firstExit(const Path&, double radius_m, const Bounds2D& area);

/// Whether two discs that drive their paths at the same time come nearer than kContactGap_m to each other, except for
/// two that start that near and draw apart.
bool meet(const Path& a, double radius_a_m, const Path& b, double radius_b_m);

}  // namespace robosim
