#include "aria/task_list.h"

#include <algorithm>

namespace robosim {

bool TaskList::has(const std::string& name) const {
  return std::any_of(tasks_.begin(), tasks_.end(), [&](const Task& task) { return task.name == name; });
}

bool TaskList::add(const std::string& name, int position, Functor functor) {
  if (has(name)) return false;
  const auto place =
      std::find_if(tasks_.begin(), tasks_.end(), [position](const Task& task) { return task.position < position; });
  tasks_.insert(place, {name, position, std::move(functor)});
  return true;
}

bool TaskList::rem(const std::string& name) {
  return std::erase_if(tasks_, [&](const Task& task) { return task.name == name; }) > 0;
}

void TaskList::run() const {
  if (tasks_.empty()) return;
  const auto tasks = tasks_;  // a task may add and remove tasks
  for (const Task& task : tasks) task.functor();
}

int CallbackList::add(Functor functor, ListPos::Pos position) {
  callbacks_.insert(position == ListPos::FIRST ? callbacks_.begin() : callbacks_.end(), {next_, std::move(functor)});
  return next_++;
}

bool CallbackList::rem(int number) {
  return std::erase_if(callbacks_, [number](const auto& entry) { return entry.first == number; }) > 0;
}

void CallbackList::call() const {
  const auto callbacks = callbacks_;  // a callback may add and remove callbacks
  for (const auto& [number, functor] : callbacks) functor();
}

}  // namespace robosim
