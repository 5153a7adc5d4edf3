#pragma once
#include <condition_variable>
#include <memory>
#include <mutex>
#include <thread>

#include "net/dial.h"
#include "remote/map_view.h"
#include "server/viewer.h"

namespace robosim {

/// The console's map, as a viewer of the environment sees it. While nobody wants it there is no connection.
class ViewerMap final : public MapSource {
 public:
  explicit ViewerMap(DialOptions environment);
  ~ViewerMap() override;

  void want(bool wanted) override;
  std::shared_ptr<const MapView> newest() override;

 private:
  void work();
  void watch();
  void show(const Sight& sight, bool is_other_world);
  void complain(const std::string& problem);

  DialOptions environment_;
  std::mutex mutex_;
  std::condition_variable bell_;
  bool is_wanted_ = false;
  bool is_over_ = false;
  Viewer* viewer_ = nullptr;  ///< the thread's own; null while it does not watch
  std::shared_ptr<const MapView> view_ = std::make_shared<MapView>();
  std::thread thread_;
};

}  // namespace robosim
