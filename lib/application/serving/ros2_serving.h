#pragma once
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/log_limiter.h"
#include "dds/participant.h"
#include "environment/environment.h"
#include "serving/robot_drivers.h"
#include "serving/ros2_changes.h"
#include "serving/ros2_outlet.h"
#include "serving/topic_feed.h"

namespace robosim {

struct Ros2Options {
  dds::Options dds;
  /// Joins the domain; of the library that implements it.
  std::function<std::unique_ptr<dds::Participant>(const dds::Options&)> join;
  std::string name_space;  ///< as of ros2Namespace()
  TopicForm form;
  bool may_drive = true;       ///< any program of the domain may drive robots
  bool may_supervise = false;  ///< any program of the domain may place, add and remove robots and objects
};

/// Connects the runs of a program to ROS 2 over DDS: topics (TopicFeed), driving (RobotDrivers), and changes by a
/// supervisor (Ros2Changes). DDS has neither tokens nor passwords: Ros2Options decides about rights. All functions are
/// called by the thread that steps the environment; none of them waits.
class Ros2Serving {
 public:
  /// Joins the domain. @param drivers of the runs; must outlive this @throws as Ros2Options::join
  Ros2Serving(const Ros2Options& options, RobotDrivers& drivers);
  /// Logs how many messages were lost.
  ~Ros2Serving();

  /// Serves a run instead of the one before. @param environment must outlive its time here
  void begin(const Environment& environment);
  /// Serves the robots that have been added to the run, too.
  void addRobots();
  /// Executes changes, and sends the state to new readers. Between steps, at least every ServingState::kPollInterval.
  void poll(const Intervene& intervene);
  /// Sends the messages of a step.
  void stepped() { feed_->stepped(); }
  /// As TopicFeed
  std::vector<std::uint8_t> pictured() const { return feed_->pictured(); }

 private:
  std::string peer() const;
  void offer(bool is_another_run);
  template <ros::Message M, typename TwistOf>
  void readCommands(const std::string& topic, const TwistOf& twist_of);

  Ros2Options options_;
  RobotDrivers& drivers_;
  LogLimiter log_;
  std::unique_ptr<dds::Participant> participant_;
  Ros2Outlet outlet_;
  const Environment* environment_ = nullptr;
  std::optional<TopicFeed> feed_;
  std::optional<Ros2Changes> changes_;                                        ///< nullopt: not permitted
  std::map<std::string, std::vector<std::unique_ptr<dds::Reader>>> readers_;  ///< by topic; ended first
};

}  // namespace robosim
