#pragma once
#include <functional>
#include <future>
#include <semaphore>
#include <thread>

namespace robosim {

/// A thread that does one piece of work after another. It is there from the start and sleeps in between, for to start a
/// thread takes up to four times as long as to wake one.
class Background {
 public:
  Background();
  /// Waits for the work that it has.
  ~Background();
  Background(const Background&) = delete;
  Background& operator=(const Background&) = delete;

  /// Gives it work; only while it has none and none has failed: call wait() first.
  void start(std::function<void()> work);
  /// Waits until the work is done; at once where there was none.
  /// @throws whatever the work threw, whenever it is asked from then on: what was to come of it is not there.
  void wait();

 private:
  void doWork();

  std::packaged_task<void()> work_;
  std::shared_future<void> done_;
  std::binary_semaphore has_work_{0};
  bool ends_ = false;
  std::thread thread_;  ///< the last to be made: it needs the others
};

}  // namespace robosim
