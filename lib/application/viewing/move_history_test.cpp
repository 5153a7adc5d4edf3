#include "viewing/move_history.h"

#include <set>

#include <gtest/gtest.h>

namespace robosim {
namespace {

/// A history with a run that answers when the test says so.
struct Moved {
  std::vector<Change> requested;
  std::set<std::string> present{"box", "Ann"};
  MoveHistory history{[this](const Change& change) { requested.push_back(change); },
                      [this](const std::string& name) { return present.contains(name); }};
};

TEST(MoveHistory, UndoesMovesFromTheLastToTheFirst) {
  Moved moved;
  moved.history.move({"box", 1, 2}, {0, 0, 0.5});
  EXPECT_EQ(moved.history.answer(""), "'box' is at x 1.00 m, y 2.00 m, 29°");
  moved.history.move({"Ann", 5, 5, M_PI / 2}, {5, 5, 0});
  EXPECT_EQ(moved.history.answer(""), "'Ann' is at x 5.00 m, y 5.00 m, 90°");
  moved.history.move({"box", 3, 4}, {1, 2, 0.5});
  moved.history.answer("");
  moved.requested.clear();
  moved.history.undo();
  EXPECT_EQ(moved.history.answer(""), "undone: 'box' is back at x 1.00 m, y 2.00 m, 29°");
  moved.history.undo();
  EXPECT_EQ(moved.history.answer(""), "undone: 'Ann' is back at x 5.00 m, y 5.00 m, 0°");
  moved.history.undo();
  moved.history.answer("");
  EXPECT_EQ(moved.requested, (std::vector<Change>{PlaceBody{"box", 1, 2, 0.5}, PlaceBody{"Ann", 5, 5, 0.0},
                                                  PlaceBody{"box", 0, 0, 0.5}}));
  EXPECT_EQ(moved.history.takeRemark(), "");
  moved.history.undo();
  EXPECT_EQ(moved.history.takeRemark(), "there is nothing to undo");
  EXPECT_EQ(moved.requested.size(), 3u);
}

TEST(MoveHistory, LeavesOutRefusedMoves) {
  Moved moved;
  moved.history.move({"box", 1, 2}, {0, 0, 0});
  EXPECT_EQ(moved.history.answer("'box' would overlap 'Ann'"), "'box' would overlap 'Ann'");
  EXPECT_EQ(moved.history.size(), 0u);
}

TEST(MoveHistory, KeepsAMoveThatCannotBeUndoneAtPresent) {
  Moved moved;
  moved.history.move({"box", 1, 2}, {0, 0, 0});
  moved.history.answer("");
  moved.history.undo();
  EXPECT_EQ(moved.history.answer("'box' would overlap 'Ann'"), "not undone: 'box' would overlap 'Ann'");
  EXPECT_EQ(moved.history.size(), 1u);
}

TEST(MoveHistory, PassesOverBodiesThatHaveLeftTheWorld) {
  Moved moved;
  moved.history.move({"Ann", 1, 2}, {0, 0, 0});
  moved.history.answer("");
  moved.history.move({"box", 3, 4}, {2, 2, 0});
  moved.history.answer("");
  moved.present.erase("box");
  moved.history.undo();
  EXPECT_EQ(moved.requested.back(), Change(PlaceBody{"Ann", 0, 0, 0.0}));
}

TEST(MoveHistory, UndoesAMoveThatIsNotYetAnsweredAfterItsAnswer) {
  Moved moved;
  moved.history.move({"box", 1, 2}, {0, 0, 0});
  moved.history.undo();
  moved.history.undo();
  EXPECT_EQ(moved.requested.size(), 1u);
  moved.history.answer("");
  EXPECT_EQ(moved.requested.back(), Change(PlaceBody{"box", 0, 0, 0.0}));
  moved.history.answer("");
  EXPECT_EQ(moved.history.takeRemark(), "there is nothing to undo");
  EXPECT_EQ(moved.requested.size(), 2u);
}

TEST(MoveHistory, ForgetsTheMovesOfAWorldThatWasReplaced) {
  Moved moved;
  moved.history.move({"box", 1, 2}, {0, 0, 0});
  moved.history.answer("");
  moved.history.move({"box", 3, 4}, {1, 2, 0});
  moved.history.clear();
  moved.history.answer("");
  EXPECT_EQ(moved.history.size(), 0u);
}

}  // namespace
}  // namespace robosim
