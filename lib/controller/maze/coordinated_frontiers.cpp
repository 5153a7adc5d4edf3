#include "maze/coordinated_frontiers.h"

#include <algorithm>
#include <cmath>

#include "maze/message_numbers.h"

namespace robosim {
namespace {

const std::string kTarget = "TARGET";

}  // namespace

void TeamTargets::set(const std::string& robot, const std::optional<mrpt::math::TPoint2D>& target) {
  const auto place = std::lower_bound(targets_.begin(), targets_.end(), robot,
                                      [](const auto& known, const std::string& name) { return known.first < name; });
  const bool is_known = place != targets_.end() && place->first == robot;
  if (target && is_known) {
    place->second = *target;
  } else if (target) {
    targets_.emplace(place, robot, *target);
  } else if (is_known) {
    targets_.erase(place);
  }
}

int TeamTargets::computeCost(const Cell& cell) const {
  const mrpt::math::TPoint2D place((cell.x + 0.5) * cell_m_, (cell.y + 0.5) * cell_m_);
  double discount_m = 0;
  for (const auto& [robot, target] : targets_) {
    const double x = place.x - target.x, y = place.y - target.y;
    const double square = x * x + y * y;
    if (square >= options_.range_m * options_.range_m) continue;
    discount_m += options_.discount_m * (1 - std::sqrt(square) / options_.range_m);
  }
  return static_cast<int>(Wavefront::kStraight * discount_m / cell_m_);
}

std::string TargetMessage::text() const {
  if (!target_m) return kTarget;
  return messageText(kTarget, {std::llround(target_m->x * 1000), std::llround(target_m->y * 1000)});
}

std::optional<TargetMessage> TargetMessage::parse(const std::string& text) {
  if (text == kTarget) return TargetMessage{};
  const auto numbers = numbersOf(text, kTarget, 2);
  if (!numbers) return std::nullopt;
  return TargetMessage{
      mrpt::math::TPoint2D(static_cast<double>((*numbers)[0]) / 1000, static_cast<double>((*numbers)[1]) / 1000)};
}

CoordinatedFrontiers::CoordinatedFrontiers(const ControllerSetup& setup, const CoordinatedFrontiersOptions& options)
    : setup_(setup), options_(options), protocol_(options.heat_threshold) {}

void CoordinatedFrontiers::step(Robot& robot) {
  protocol_.step(robot);
  if (robot.activity() != Activity::active) return;
  if (!explorer_) {
    explorer_.emplace(robot, setup_, protocol_.warm(), setup_.world_from_start.value_or(mrpt::math::TPose2D()));
    targets_.emplace(options_, explorer_->map().cellSize());
  }
  if (setup_.world_from_start) listen(robot);
  explorer_->step(robot, &*targets_);
  if (setup_.world_from_start) speak(robot);
}

void CoordinatedFrontiers::listen(const Robot& robot) {
  for (const RobotMessage& message : robot.inbox()) {
    if (const auto target = TargetMessage::parse(message.text)) {
      targets_->set(message.from, target->target_m);
    } else if (const auto map = MapMessage::parse(message.text)) {
      sharing_.receive(*map, explorer_->search());
    }
  }
}

void CoordinatedFrontiers::speak(Robot& robot) {
  const auto target = explorer_->searchGoal();
  if (target != sent_target_) {
    sent_target_ = target;
    TargetMessage message;
    if (target) message.target_m = explorer_->map().center(*target);
    robot.broadcast(message.text());
  }
  if (robot.stepNumber() % robot.stepsIn(options_.share_s) != setup_.robot % robot.stepsIn(options_.share_s)) return;
  if (const auto part = sharing_.next(explorer_->map())) robot.broadcast(part->text());
}

}  // namespace robosim
