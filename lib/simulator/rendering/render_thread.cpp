#include "rendering/render_thread.h"

#include <condition_variable>
#include <deque>
#include <future>
#include <map>
#include <mutex>
#include <thread>

#include <GL/gl.h>

#include "base/error_list.h"
#include "rendering/picture_target.h"

namespace robosim {
namespace {

/// Framebuffers by size. The first one creates the OpenGL context shared by all, so it is destroyed last.
class ContextTargets : public RenderThread::Targets {
 public:
  ContextTargets() : context_(16, 16) {
    // MRPT's images have no row padding, so OpenGL must not write any.
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
  }

  PictureTarget& ofSize(unsigned width_px, unsigned height_px) override {
    auto& target = of_size_[{width_px, height_px}];
    if (!target) {
      PictureTarget::Parameters parameters(width_px, height_px);
      parameters.create_EGL_context = false;
      target = std::make_unique<PictureTarget>(parameters);
    }
    return *target;
  }

 private:
  PictureTarget context_;
  std::map<std::pair<unsigned, unsigned>, std::unique_ptr<PictureTarget>> of_size_;
};

/// Extracts the message from MRPT's exception text, which surrounds it with a heading and a stack trace.
std::string messageOf(const std::exception& error) {
  const std::string text = error.what(), heading = "Message:";
  const auto found = text.find(heading);
  auto begin = found == std::string::npos ? 0 : found + heading.size();
  while (begin < text.size() && text[begin] == ' ') ++begin;
  return text.substr(begin, text.find('\n', begin) - begin);
}

}  // namespace

struct RenderThread::Impl {
  using Task = std::packaged_task<void(Targets&)>;

  void work(std::promise<void> ready);
  void put(Task task) {
    {
      const std::lock_guard lock(mutex);
      tasks.push_back(std::move(task));
    }
    condition.notify_one();
  }

  std::mutex mutex;
  std::condition_variable condition;
  std::deque<Task> tasks;  ///< an invalid task ends the thread
  std::thread thread;
};

void RenderThread::Impl::work(std::promise<void> ready) {
  std::unique_ptr<ContextTargets> targets;
  try {
    targets = std::make_unique<ContextTargets>();
    ready.set_value();
  } catch (...) {
    return ready.set_exception(std::current_exception());
  }
  for (;;) {
    std::unique_lock lock(mutex);
    condition.wait(lock, [this] { return !tasks.empty(); });
    Task task = std::move(tasks.front());
    tasks.pop_front();
    lock.unlock();
    if (!task.valid()) return;
    task(*targets);
  }
}

RenderThread::RenderThread() : impl_(std::make_unique<Impl>()) {
  std::promise<void> ready;
  auto is_ready = ready.get_future();
  impl_->thread = std::thread(&Impl::work, impl_.get(), std::move(ready));
  try {
    is_ready.get();
  } catch (const std::exception& error) {
    impl_->thread.join();
    throw ConfigError(
        "cameras need OpenGL, and this machine has none (" + messageOf(error) +
        "); install its drivers: apt-get install libegl1 libgl1-mesa-dri. Worlds without cameras need none");
  }
}

RenderThread::~RenderThread() {
  impl_->put({});
  impl_->thread.join();
}

std::shared_ptr<RenderThread> RenderThread::shared() {
  static std::mutex mutex;
  static std::weak_ptr<RenderThread> running;
  const std::lock_guard lock(mutex);
  auto thread = running.lock();
  if (!thread) {
    thread.reset(new RenderThread);
    running = thread;
  }
  return thread;
}

void RenderThread::run(const std::function<void(Targets&)>& work) {
  Impl::Task task(work);
  auto done = task.get_future();
  impl_->put(std::move(task));
  done.get();
}

}  // namespace robosim
