#include "dynamics/shifts.h"

#include <algorithm>
#include <array>

#include "dynamics/convergence.h"

namespace robosim {
namespace {

using With = PushingGroup::Pair::With;

constexpr int kShiftSweepsMax = 200;
/// Gaps that are smaller by less need no shift [m].
constexpr double kFault_m = kContactGap_m / 4;

/// The pushes at both points after which they have the gaps that they need: the linear complementarity problem, in
/// which a point is not pushed where the push at the other one suffices.
std::array<double, 2> pushesFor(const Contact& contact, const Lever& first, const Lever& second) {
  const auto mobility = [&](int i, int j) { return first.mobility(i, j) + second.mobility(i, j); };
  const double need_0 = kContactGap_m - contact.points[0].gap_m;
  const double only_0 = std::max(0.0, need_0 / mobility(0, 0));
  if (contact.count == 1) return {only_0, 0};
  const double need_1 = kContactGap_m - contact.points[1].gap_m;
  const double determinant = mobility(0, 0) * mobility(1, 1) - mobility(0, 1) * mobility(0, 1);
  if (determinant > 0) {
    const double both_0 = (need_0 * mobility(1, 1) - need_1 * mobility(0, 1)) / determinant;
    const double both_1 = (need_1 * mobility(0, 0) - need_0 * mobility(0, 1)) / determinant;
    if (both_0 >= 0 && both_1 >= 0) return {both_0, both_1};
  }
  if (need_1 > need_0) return {0, need_1 / mobility(1, 1)};
  return {only_0, 0};
}

void shift(const PushingGroup& group, const PushingGroup::Pair& pair, const Contact& contact, GroupMoment& moment) {
  const Lever first = leverOf(group, moment, With::object, pair.first, contact);
  const Lever second = leverOf(group, moment, pair.with, pair.second, contact);
  if (first.per_mass + second.per_mass == 0) return;  // neither gives way: a door and a robot
  const auto pushes = pushesFor(contact, first, second);
  const auto move = [&](std::uint32_t i, const Lever& lever, double sign) {
    auto& pose = moment.objects[i].world_from_object;
    const double sum = sign * (pushes[0] + pushes[1]);
    pose.x += contact.normal.x * sum * lever.per_mass;
    pose.y += contact.normal.y * sum * lever.per_mass;
    pose.phi += sign * (pushes[0] * lever.arm_m[0] + pushes[1] * lever.arm_m[1]) * lever.per_turn;
    outline(group, i, moment);
  };
  move(pair.first, first, -1);
  if (pair.with == With::object) move(pair.second, second, 1);
}

}  // namespace

void shiftApart(const PushingGroup& group, const Island& island, GroupMoment& moment,
                std::vector<std::uint8_t>& pushing) {
  Convergence progress;
  for (int sweep = 0; sweep < kShiftSweepsMax; ++sweep) {
    double narrowest_m = kContactGap_m;
    for (const std::uint32_t p : island.pairs) {
      const auto& pair = group.pairs[p];
      if (pair.with == With::two_robots || !mayTouch(group, moment, pair, kContactGap_m)) continue;
      const Contact contact = contactOf(group, moment, pair);
      if (contact.gap() >= kContactGap_m - kFault_m) continue;
      narrowest_m = std::min(narrowest_m, contact.gap());
      shift(group, pair, contact, moment);
      pushing[p] = 1;
    }
    if (progress.isOver(kContactGap_m - narrowest_m)) return;
  }
}

}  // namespace robosim
