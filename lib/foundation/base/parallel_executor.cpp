#include "base/parallel_executor.h"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

namespace robosim {

namespace tbb = oneapi::tbb;

class ParallelExecutor::Threads {
 public:
  explicit Threads(int threads)
      : allowance_(tbb::global_control::max_allowed_parallelism,
                   static_cast<std::size_t>(std::max(threads, tbb::info::default_concurrency()))),
        arena_(threads) {}

  void run(std::size_t pieces, const std::function<void(std::size_t)>& work) {
    arena_.execute([&] { tbb::parallel_for(std::size_t{0}, pieces, work); });
  }

 private:
  tbb::global_control allowance_;
  tbb::task_arena arena_;
};

ParallelExecutor::ParallelExecutor(int threads)
    : threads_(std::max(1, threads)), pool_(threads_ > 1 ? std::make_unique<Threads>(threads_) : nullptr) {}

ParallelExecutor::~ParallelExecutor() = default;

void ParallelExecutor::distribute(std::size_t pieces, const std::function<void(std::size_t)>& work) const {
  pool_->run(pieces, work);
}

}  // namespace robosim
