#pragma once
#include <functional>
#include <memory>

namespace robosim {

class PictureTarget;

/// The one thread that draws off screen, with the OpenGL context that it owns. Contexts of several threads would do as
/// well, but MRPT takes its display down with each of them.
class RenderThread {
 public:
  /// What is drawn into, for one size of pictures. In the render thread only.
  class Targets {
   public:
    virtual ~Targets() = default;
    virtual PictureTarget& ofSize(unsigned width_px, unsigned height_px) = 0;
  };

  /// The program's only one; it starts when first asked for, and ends with the last who holds on to it.
  /// @throws ConfigError when this machine has no OpenGL, with the packages that bring it.
  static std::shared_ptr<RenderThread> shared();

  ~RenderThread();
  RenderThread(const RenderThread&) = delete;
  RenderThread& operator=(const RenderThread&) = delete;

  /// Has the thread do it, and waits until it is done. Any thread may call. What `work` throws is thrown here.
  void run(const std::function<void(Targets&)>& work);

 private:
  RenderThread();
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace robosim
