#pragma once
#include <string>
#include <utility>
#include <vector>

namespace robosim {

class PioneerRobot;

/// A wish for one quantity, and how much of it is settled: 0 nothing, 1 all.
struct DesiredChannel {
  double value = 0;
  double strength = 0;

  /// What is not settled yet is settled by `lower`, as far as its strength goes.
  void fillFrom(const DesiredChannel& lower);
  /// The wish of several equals: their mean, weighted by strength.
  void average(const DesiredChannel& other);
};

/// What an action wants of the robot in one step, in ARIA's units. Strengths lie in [0, 1].
class ActionDesired {
 public:
  static constexpr double NO_STRENGTH = 0, MIN_STRENGTH = 1e-6, MAX_STRENGTH = 1;

  void setVel(double mm_ps, double strength = MAX_STRENGTH);
  /// A turn relative to the present heading [deg].
  void setDeltaHeading(double deg, double strength = MAX_STRENGTH);
  void setRotVel(double deg_ps, double strength = MAX_STRENGTH);
  /// No faster ahead than this. Of several limits the lowest counts, whatever the priorities.
  void setMaxVel(double mm_ps);
  /// No faster backwards than this, which is negative. Of several limits the one nearest to 0 counts.
  void setMaxNegVel(double mm_ps);
  void reset() { *this = {}; }

  double getVel() const { return vel_.value; }
  double getVelStrength() const { return vel_.strength; }
  double getDeltaHeading() const { return turn_.value; }
  double getDeltaHeadingStrength() const { return turns_by_speed_ ? NO_STRENGTH : turn_.strength; }
  double getRotVel() const { return turn_.value; }
  double getRotVelStrength() const { return turns_by_speed_ ? turn_.strength : NO_STRENGTH; }
  double getMaxVel() const { return max_vel_; }
  double getMaxNegVel() const { return max_neg_vel_; }

  /// Settles what this leaves open from actions of lower priority.
  void fillFrom(const ActionDesired& lower);
  /// Joins the wish of an action of equal priority. Of two kinds of turning the first one's is kept.
  void average(const ActionDesired& other);

 private:
  void setTurn(double value, double strength, bool by_speed);

  static constexpr double kUnlimited = 1e9;
  DesiredChannel vel_, turn_;
  bool turns_by_speed_ = false;  ///< turn_ is a speed [deg/s]; otherwise an angle [deg]
  double max_vel_ = kUnlimited, max_neg_vel_ = -kUnlimited;
};

/// A behaviour, one of several that drive a PioneerRobot together, as ARIA's ArAction.
class Action {
 public:
  explicit Action(std::string name) : name_(std::move(name)) {}
  virtual ~Action() = default;
  const std::string& getName() const { return name_; }

  /// Called once a step. @return what it wants; a default ActionDesired for nothing.
  /// @param current what the actions of higher priority have settled so far.
  virtual ActionDesired fire(PioneerRobot& robot, const ActionDesired& current) = 0;

 private:
  std::string name_;
};

/// The actions of one robot, and how their wishes become one: the highest priority settles what it wants, as far as its
/// strength goes; the next fills what is left open, and so on. Actions of one priority are averaged first.
class ActionList {
 public:
  /// @param action must outlive its place in the list.
  void add(Action& action, int priority);
  /// @return false when it is not in the list.
  bool remove(const Action& action);
  bool empty() const { return entries_.empty(); }
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
