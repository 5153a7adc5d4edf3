#include "control/blocking_controller.h"

#include <exception>
#include <semaphore>
#include <thread>
#include <utility>

namespace robosim {
namespace {

struct RunEnded {};  // no std::exception, so that a program's own catch clauses do not hold it up

}  // namespace

/// The program and its thread. `go_` wakes the program, `done_` wakes the caller of step(): the two take turns.
class BlockingController::Loop final : public StepClock {
 public:
  explicit Loop(Program program) : program_(std::move(program)) {}

  ~Loop() {
    if (!thread_.joinable()) return;
    ending_ = true;
    go_.release();
    thread_.join();
  }

  void step(Robot& robot) {
    if (finished_) return;
    if (!thread_.joinable()) {
      thread_ = std::thread([this, &robot] { run(robot); });
    }
    go_.release();
    done_.acquire();
    if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
  }

  void waitForNextStep() override {
    if (!ending_) {
      done_.release();
      go_.acquire();
    }
    if (ending_) throw RunEnded{};
  }

 private:
  void run(Robot& robot) {
    go_.acquire();
    try {
      program_(robot, *this);
      if (robot.activity() == Activity::active) robot.halt();
    } catch (const RunEnded&) {
    } catch (...) {
      robot.stop();
      failure_ = std::current_exception();
    }
    finished_ = true;
    done_.release();
  }

  Program program_;
  std::binary_semaphore go_{0}, done_{0};
  bool ending_ = false;  // each of these is touched only by the one whose turn it is
  bool finished_ = false;
  std::exception_ptr failure_;
  std::thread thread_;
};

BlockingController::BlockingController(Program program) : loop_(std::make_unique<Loop>(std::move(program))) {}

BlockingController::~BlockingController() = default;

void BlockingController::step(Robot& robot) { loop_->step(robot); }

}  // namespace robosim
