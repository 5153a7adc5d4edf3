#include "base/background.h"

#include <cassert>
#include <utility>

namespace robosim {

Background::Background() : thread_([this] { doWork(); }) {}

Background::~Background() {
  if (done_.valid()) done_.wait();
  ends_ = true;
  has_work_.release();
  thread_.join();
}

void Background::start(std::function<void()> work) {
  assert(!done_.valid());
  work_ = std::packaged_task<void()>(std::move(work));
  done_ = work_.get_future();
  has_work_.release();
}

void Background::wait() {
  if (done_.valid()) done_.get();
}

void Background::doWork() {
  for (has_work_.acquire(); !ends_; has_work_.acquire()) work_();
}

}  // namespace robosim
