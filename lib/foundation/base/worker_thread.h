#pragma once
#include <functional>
#include <future>
#include <semaphore>
#include <thread>

namespace robosim {

/// A thread that executes one task at a time. It is created once and sleeps between tasks: starting a thread takes up
/// to four times as long as waking one.
class WorkerThread {
 public:
  WorkerThread();
  /// Waits for the current task.
  ~WorkerThread();
  WorkerThread(const WorkerThread&) = delete;
  WorkerThread& operator=(const WorkerThread&) = delete;

  /// Starts a task. @pre no task is running and none has failed: call wait() first
  void start(std::function<void()> work);
  /// Waits until the current task is done; returns at once if there is none.
  /// @throws the exception of a failed task, in this and every later call.
  void wait();

 private:
  void doWork();

  std::packaged_task<void()> work_;
  std::shared_future<void> done_;
  std::binary_semaphore has_work_{0};
  bool ends_ = false;
  std::thread thread_;  ///< initialised last: it uses the other members
};

}  // namespace robosim
