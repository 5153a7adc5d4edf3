#pragma once
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace robosim {

class PioneerRobot;

/// Desired value of one quantity with its strength: 0 leaves it open, 1 determines it.
struct DesiredChannel {
  double value = 0;
  double strength = 0;

  /// Fills the remaining strength from an action of lower priority.
  void fillFrom(const DesiredChannel& lower);
  /// Combines actions of equal priority: the mean, weighted by strength.
  void average(const DesiredChannel& other);
};

/// Desired motion of an action in one step, in ARIA's units. Strengths lie in [0, 1].
class ActionDesired {
 public:
  static constexpr double NO_STRENGTH = 0, MIN_STRENGTH = 1e-6, MAX_STRENGTH = 1;

  void setVel(double mm_ps, double strength = MAX_STRENGTH);
  /// A turn relative to the present heading [deg].
  void setDeltaHeading(double deg, double strength = MAX_STRENGTH);
  /// A heading in the frame of PioneerRobot::getPose() [deg]; the resolver turns it into a turn by the smaller angle.
  void setHeading(double deg, double strength = MAX_STRENGTH);
  void setRotVel(double deg_ps, double strength = MAX_STRENGTH);
  /// Maximum forward speed. The lowest of several limits applies, regardless of priority.
  void setMaxVel(double mm_ps);
  /// Maximum backward speed, negative. The limit nearest to 0 applies, regardless of priority.
  void setMaxNegVel(double mm_ps);
  /// Maximum turn speed, to either side. The lowest of several limits applies, regardless of priority.
  void setMaxRotVel(double deg_ps);
  /// @name Accelerations [mm/s², deg/s²] for this step in place of the robot's, limited by the hardware
  /// Of several actions, the lowest acceleration and the highest deceleration apply. @param value positive
  ///@{
  void setTransAccel(double value) { trans_accel_ = value; }
  void setTransDecel(double value) { trans_decel_ = value; }
  void setRotAccel(double value) { rot_accel_ = value; }
  void setRotDecel(double value) { rot_decel_ = value; }
  ///@}
  void reset() { *this = {}; }

  double getVel() const { return vel_.value; }
  double getVelStrength() const { return vel_.strength; }
  double getDeltaHeading() const { return turn_.value; }
  double getDeltaHeadingStrength() const { return turns_by_speed_ ? NO_STRENGTH : turn_.strength; }
  double getRotVel() const { return turn_.value; }
  double getRotVelStrength() const { return turns_by_speed_ ? turn_.strength : NO_STRENGTH; }
  double getMaxVel() const { return max_vel_; }
  double getMaxNegVel() const { return max_neg_vel_; }
  double getMaxRotVel() const { return max_rot_vel_; }
  /// MAX_STRENGTH with a limit, NO_STRENGTH without.
  double getMaxVelStrength() const { return max_vel_ < kUnlimited ? MAX_STRENGTH : NO_STRENGTH; }
  double getMaxNegVelStrength() const { return max_neg_vel_ > -kUnlimited ? MAX_STRENGTH : NO_STRENGTH; }
  double getMaxRotVelStrength() const { return max_rot_vel_ < kUnlimited ? MAX_STRENGTH : NO_STRENGTH; }
  /// nullopt to leave the robot's.
  std::optional<double> getTransAccel() const { return trans_accel_; }
  std::optional<double> getTransDecel() const { return trans_decel_; }
  std::optional<double> getRotAccel() const { return rot_accel_; }
  std::optional<double> getRotDecel() const { return rot_decel_; }
  /// Replaces a desired heading by the turn from the present heading [deg].
  void accountForRobotHeading(double th_deg);

  /// Fills the quantities left open from an action of lower priority.
  void fillFrom(const ActionDesired& lower);
  /// Adds an action of equal priority. Of a turn angle and a turn speed the first is kept.
  void average(const ActionDesired& other);

 private:
  void setTurn(double value, double strength, bool by_speed);
  void limitAsWell(const ActionDesired& other);

  static constexpr double kUnlimited = 1e9;
  DesiredChannel vel_, turn_;
  bool turns_by_speed_ = false;  ///< turn_ is a speed [deg/s]; otherwise an angle [deg]
  bool is_heading_ = false;      ///< turn_ is a heading until accountForRobotHeading()
  double max_vel_ = kUnlimited, max_neg_vel_ = -kUnlimited, max_rot_vel_ = kUnlimited;
  std::optional<double> trans_accel_, trans_decel_, rot_accel_, rot_decel_;
};

/// A behaviour that drives a PioneerRobot together with others, like ARIA's ArAction.
class Action {
 public:
  explicit Action(std::string name) : name_(std::move(name)) {}
  virtual ~Action() = default;
  const std::string& getName() const { return name_; }
  /// Called by PioneerRobot::addAction(), and with null by remAction().
  virtual void setRobot(PioneerRobot* robot) { robot_ = robot; }
  PioneerRobot* getRobot() const { return robot_; }  ///< null while the action belongs to no robot

  /// An action that is not active is ignored. All are active at first. An override calls these.
  virtual void activate() { is_active_ = true; }
  virtual void deactivate() { is_active_ = false; }
  bool isActive() const { return is_active_; }

  /// Called once per step while the action is active. @return the desired motion; a default ActionDesired for none.
  /// @param current the result of the actions of higher priority.
  virtual ActionDesired fire(PioneerRobot& robot, const ActionDesired& current) = 0;

 private:
  std::string name_;
  PioneerRobot* robot_ = nullptr;
  bool is_active_ = true;
};

/// Resolver of the actions of one robot. The highest priority determines each quantity up to its strength, and each
/// lower priority fills the remainder. Actions of equal priority are averaged first.
class ActionList {
 public:
  /// @param action must outlive its place in the list.
  void add(Action& action, int priority);
  /// @return false when the action is not in the list.
  bool remove(const Action& action);
  bool empty() const { return entries_.empty(); }
  void deactivateAll() const;
  /// By name; null when there is none.
  Action* find(const std::string& name) const;

  ActionDesired resolve(PioneerRobot& robot) const;

 private:
  struct Entry {
    int priority;
    Action* action;
  };
  std::vector<Entry> entries_;  ///< highest priority first; equals in the order they were added
};

}  // namespace robosim
