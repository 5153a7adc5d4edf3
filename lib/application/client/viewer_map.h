#pragma once
#include <condition_variable>
#include <memory>
#include <mutex>
#include <thread>

#include "client/viewer.h"
#include "console/map_view.h"
#include "net/connect.h"

namespace robosim {

/// Map of the console, received as a viewer of the environment. Connected only while the map is requested.
class ViewerMap final : public MapSource {
 public:
  explicit ViewerMap(ConnectOptions environment);
  ~ViewerMap() override;

  void setWatched(bool is_watched) override;
  std::shared_ptr<const MapView> newest() override;

 private:
  void work();
  void receive();
  void show(const ViewedRun& viewed_run, bool is_other_world);
  void placeObjects(const ViewedRun& viewed_run, MapView& view);
  void showProblem(const std::string& problem);

  ConnectOptions environment_;
  std::mutex mutex_;
  std::condition_variable condition_;
  bool is_watched_ = false;
  bool is_over_ = false;
  Viewer* viewer_ = nullptr;  ///< owned by the thread; null while not connected
  /// @name Of the thread
  ///@{
  ChangedObjects map_objects_;    ///< those of MapView::world
  ChangedObjects shown_objects_;  ///< those of the newest view
  ///@}
  std::shared_ptr<const MapView> view_ = std::make_shared<MapView>();
  std::thread thread_;
};

}  // namespace robosim
