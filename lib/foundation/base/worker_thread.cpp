#include "base/worker_thread.h"

#include <cassert>
#include <chrono>
#include <utility>

namespace robosim {

WorkerThread::WorkerThread() : thread_([this] { doWork(); }) {}

WorkerThread::~WorkerThread() {
  if (done_.valid()) done_.wait();
  ends_ = true;
  has_work_.release();
  thread_.join();
}

void WorkerThread::start(std::function<void()> work) {
  assert(!done_.valid() || done_.wait_for(std::chrono::seconds(0)) == std::future_status::ready);
  work_ = std::packaged_task<void()>(std::move(work));
  done_ = work_.get_future();
  has_work_.release();
}

void WorkerThread::wait() {
  if (done_.valid()) done_.get();
}

void WorkerThread::doWork() {
  for (has_work_.acquire(); !ends_; has_work_.acquire()) {
    auto work = std::exchange(work_, {});  // once it is done, the next task may be started
    work();
  }
}

}  // namespace robosim
