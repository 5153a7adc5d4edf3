#include "base/background.h"

#include <cassert>
#include <chrono>
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
  assert(!done_.valid() || done_.wait_for(std::chrono::seconds(0)) == std::future_status::ready);
  work_ = std::packaged_task<void()>(std::move(work));
  done_ = work_.get_future();
  has_work_.release();
}

void Background::wait() {
  if (done_.valid()) done_.get();
}

void Background::doWork() {
  for (has_work_.acquire(); !ends_; has_work_.acquire()) {
    auto work = std::exchange(work_, {});  // once it is done, the next may come
    work();
  }
}

}  // namespace robosim
