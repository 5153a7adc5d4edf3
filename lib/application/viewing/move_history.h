#pragma once
#include <deque>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <mrpt/math/TPose2D.h>

#include "world/intervention.h"

namespace robosim {

/// The places to which a person has moved robots and objects of a run, which can be undone, the last first. Undoing
/// places a body where it was: a further change of the run. The run answers each requested change once, in their order.
class MoveHistory {
 public:
  /// @param request sends a change to the run
  /// @param is_present whether a robot or an object of this name is in the world
  MoveHistory(std::function<void(const Change&)> request, std::function<bool(const std::string&)> is_present)
      : request_(std::move(request)), is_present_(std::move(is_present)) {}

  /// @param was where the body is
  void move(const PlaceBody& place, const mrpt::math::TPose2D& was);
  /// Undoes the last move; while an answer is due, after it. Moves of bodies that have left the world are dropped. A
  /// move that cannot be undone at present remains the last.
  void undo();
  /// The run has answered the first change that is unanswered.
  /// @param fault why it has refused it; empty if it is applied
  /// @return what has been done, or why not, for the person
  std::string answer(const std::string& fault);
  /// Forgets all moves: the run has another world.
  void clear();
  /// The number of moves that can be undone.
  std::size_t size() const { return moves_.size(); }
  /// What undo() says at once: that there is nothing to undo. Empty otherwise.
  std::string takeRemark() { return std::exchange(remark_, {}); }

 private:
  /// A change that is applied, or requested.
  struct Move {
    PlaceBody place;
    mrpt::math::TPose2D was;
    bool is_undo = false;
    bool is_outdated = false;  ///< of a world before
  };

  void undoNow();

  std::function<void(const Change&)> request_;
  std::function<bool(const std::string&)> is_present_;
  std::vector<Move> moves_;     ///< applied
  std::deque<Move> requested_;  ///< unanswered
  std::size_t undos_due_ = 0;
  std::string remark_;
};

}  // namespace robosim
