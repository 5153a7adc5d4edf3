#pragma once
#include <functional>
#include <memory>

namespace robosim {

class PictureTarget;

/// The single thread that renders off screen, and owns the OpenGL context. MRPT closes its display connection with each
/// context, so several contexts in several threads do not work.
class RenderThread {
 public:
  /// Framebuffers by size. Used in the render thread only.
  class Targets {
   public:
    virtual ~Targets() = default;
    virtual PictureTarget& ofSize(unsigned width_px, unsigned height_px) = 0;
  };

  /// The process's only instance: created on first use, destroyed with the last reference.
  /// @throws ConfigError when this machine has no OpenGL; the text names the packages to install.
  static std::shared_ptr<RenderThread> shared();

  ~RenderThread();
  RenderThread(const RenderThread&) = delete;
  RenderThread& operator=(const RenderThread&) = delete;

  /// Runs `work` in the render thread and waits for it. May be called from any thread. Rethrows what `work` throws.
  void run(const std::function<void(Targets&)>& work);

 private:
  RenderThread();
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace robosim
