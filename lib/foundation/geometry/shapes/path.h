#pragma once
#include <span>

#include <mrpt/math/TPoint2D.h>
#include <mrpt/math/TPose2D.h>

#include "geometry/shapes/solid.h"

namespace robosim {

/// Gap [m] that a clipped move leaves before the contact, so that rounding never makes two bodies overlap.
constexpr double kContactGap_m = 1e-6;

/// Path of a disc's centre through one time step: an arc of constant curvature, approximated by a chain of chords whose
/// ends lie on the arc. Each chord turns by at most 3°, so it deviates from an arc of 1 m radius by less than 0.4 mm.
/// The robot drives the chords; queries on them are exact. Fractions run over the whole step, [0, 1], in time and
/// length alike.
struct Path {
  mrpt::math::TPose2D world_from_start;
  double length_m = 0;      ///< signed: negative backwards
  double turn_rad = 0;      ///< signed, CCW
  double end_fraction = 1;  ///< fraction at which the centre stops; the turn still completes, unless turn_stops
  /// The turn stops with the centre, as of a car, or of a robot that holds an object. Its chords are shorter: at 0.5 m
  /// from the centre they deviate from the arc by less than a fifth of kContactGap_m.
  bool turn_stops = false;
  /// Direction in which the centre leaves the start, from its heading, CCW: 0 for a robot that drives ahead or back.
  /// It turns with the robot.
  double direction_rad = 0;

  int chords() const;
  /// Position of the centre at a fraction of the step; constant beyond end_fraction.
  mrpt::math::TPoint2D centerAt(double fraction) const;
  /// Pose at the end of the step: the centre where it stopped, the heading as far as it turned, within (-π, π].
  mrpt::math::TPose2D endPose() const;
  double clippedLength() const { return length_m * end_fraction; }                        ///< signed [m]
  double clippedTurn() const { return turn_stops ? turn_rad * end_fraction : turn_rad; }  ///< signed [rad]
};

/// Sets poses to Path::endPose() of many paths, computed together in vectors, bit for bit.
/// @param paths at most ChordBatch::kCapacity @param poses as many
void computeEndPoses(std::span<const Path* const> paths, std::span<mrpt::math::TPose2D* const> poses);

/// Fraction in [0, 1] at which a disc on the path first comes within kContactGap_m of the outline; 1 when it never does
/// (swept-disc test). A disc that starts within the gap may leave or slide along; it is stopped (0) if it would
/// approach. Considers the path only up to its end_fraction.
double firstContact(const Path&, double radius_m, const Outline&);

/// Fraction in [0, 1] at which a disc on the path first comes within kContactGap_m of the edge of `area` from inside; 1
/// when it never does. A disc that starts beyond that may return; it is stopped (0) if it would go further out.
double firstExit(const Path&, double radius_m, const Bounds2D& area);

/// Whether two discs that drive their paths simultaneously come closer than kContactGap_m. Two discs that start within
/// the gap and separate do not collide.
bool collide(const Path& a, double radius_a_m, const Path& b, double radius_b_m);

}  // namespace robosim
