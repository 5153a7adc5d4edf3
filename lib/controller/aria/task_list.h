#pragma once
#include <string>
#include <utility>
#include <vector>

#include "aria/functor.h"

namespace robosim {

/// Named functions that are called once per step, as ARIA's ArSyncTask: the highest position first, equals in the order
/// in which they were added.
class TaskList {
 public:
  /// @return false, without effect, when there is a task of this name
  bool add(const std::string& name, int position, Functor functor);
  bool rem(const std::string& name);  ///< @return false when there is no such task
  bool has(const std::string& name) const;
  /// Calls each task that was in the list at the start of the call.
  void run() const;

 private:
  struct Task {
    std::string name;
    int position;
    Functor functor;
  };
  std::vector<Task> tasks_;
};

/// Functions that are called upon an event.
class CallbackList {
 public:
  /// @return the number by which rem() finds it
  int add(Functor functor, ListPos::Pos position = ListPos::LAST);
  bool rem(int number);  ///< @return false when there is no such callback
  void call() const;

 private:
  std::vector<std::pair<int, Functor>> callbacks_;
  int next_ = 1;
};

}  // namespace robosim
