#include "run_page/run_page.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <mrpt/core/format.h>

#include "base/printable_text.h"
#include "base/text_table.h"
#include "run_page/page_world.h"

namespace robosim {
namespace {

using nlohmann::ordered_json;

constexpr double kGroundMargin_m = 0.5;          ///< around the poses of a run without a world
constexpr std::size_t kProgram_bytes = 400'000;  ///< of a page, without data
constexpr double kLast_us = 0x1p51;              ///< second differences of times are exact in JavaScript
constexpr std::size_t kText_bytes = 200;         ///< of a message or an intervention; the middle of others is omitted
constexpr std::size_t kMaxListed = 20'000;       ///< objects in the lists after the first one

std::string timeText(std::int64_t time_us) { return mrpt::format("%.3f s", static_cast<double>(time_us) * 1e-6); }

/// The part of `count` elements that fits into `limit` of the bytes that they take, and is smaller.
std::size_t fewer(std::size_t count, std::size_t limit, std::size_t bytes) {
  const double part = 0.95 * static_cast<double>(limit) / static_cast<double>(bytes);
  return std::min(count - 1, static_cast<std::size_t>(part * static_cast<double>(count)));
}

}  // namespace

std::size_t RunPage::maxBytes(std::size_t robots, double duration_s) {
  constexpr double kPerRobotMinute = 35'000, kLeast = 1.4e6, kMost = 14e6;
  return static_cast<std::size_t>(
      std::clamp(static_cast<double>(robots) * duration_s / 60 * kPerRobotMinute, kLeast, kMost));
}

std::size_t RunPage::addRobot(FleetRobot robot) {
  robots_.push_back({std::move(robot), PoseTrack(tolerance_), {}});
  return robots_.size() - 1;
}

void RunPage::beginMoment(double time_s) {
  are_times_limited_ |= !(std::abs(time_s) * 1e6 <= kLast_us);
  const double limited_us = std::isfinite(time_s) ? std::clamp(time_s * 1e6, -kLast_us, kLast_us) : 0;
  const auto time_us = static_cast<std::int64_t>(std::llround(limited_us));
  const std::size_t size = times_us_.size();
  const bool is_last_wrong = size > 0 && time_us < times_us_[size - 1] - PoseTrack::kAhead_us;
  if (is_last_wrong && (size == 1 || times_us_[size - 2] <= time_us)) times_us_.back() = time_us;
  times_us_.push_back(size == 0 ? time_us : std::max(time_us, times_us_.back()));
  noteObjects();
}

void RunPage::noteObjects() {
  if (!world_ || objects_end_us_) return;
  const bool is_first = objects_.empty();
  if (!is_first && next_objects_.isSameList(last_objects_)) return;
  const auto& now = next_objects_.orThose(world_->objects);
  if (!is_first) {
    const auto& before = last_objects_.orThose(world_->objects);
    if (const auto moved = movedBetween(before, now)) {
      ObjectList& list = objects_.back();
      const double time_s = static_cast<double>(times_us_.back()) * 1e-6;
      for (const std::uint32_t i : *moved) {
        auto& track = list.tracks[i];
        if (!track) {
          track.emplace(tolerance_);
          track->add(list.moment, static_cast<double>(times_us_[list.moment]) * 1e-6, before[i].body.world_from_body);
        }
        // It stood still until the moment before.
        if (moment() > list.moment) {
          const auto keys_end = moment() - 1;
          if (keys_end > last_moved_[i]) {
            track->add(keys_end, static_cast<double>(times_us_[keys_end]) * 1e-6, before[i].body.world_from_body);
          }
        }
        track->add(moment(), time_s, now[i].body.world_from_body);
        last_moved_[i] = moment();
      }
      last_objects_ = next_objects_;
      return;
    }
  }
  if (!is_first && (listed_ += now.size()) > kMaxListed) {
    objects_end_us_ = times_us_.back();
    return;
  }
  objects_.push_back({moment(), next_objects_, std::vector<std::optional<PoseTrack>>(now.size())});
  last_moved_.assign(now.size(), moment());
  last_objects_ = next_objects_;
}

void RunPage::setPose(std::size_t robot, const mrpt::math::TPose2D& world_from_robot) {
  robots_[robot].track.add(moment(), static_cast<double>(times_us_.back()) * 1e-6, world_from_robot);
}

void RunPage::setState(std::size_t robot, const PageRobotState& state) {
  auto& states = robots_[robot].states;
  if (states.empty() ? state == PageRobotState() : states.back().state == state) return;
  states.push_back({moment(), state});
}

void RunPage::addEvent(const std::string& kind, std::optional<std::size_t> robot, const std::string& text,
                       bool is_next) {
  if (events_.size() == kMaxTexts) {
    ++left_out_events_;
    return;
  }
  events_.push_back({is_next ? times_us_.size() : moment(), kind, robot, shortened(text, kText_bytes)});
}

ordered_json RunPage::events(std::size_t count) const {
  ordered_json events = ordered_json::array();
  for (std::size_t i = 0; i < count; ++i) {
    const Event& event = events_[i];
    events.push_back({event.moment, event.kind, event.robot ? ordered_json(*event.robot) : ordered_json(), event.text});
  }
  return events;
}

ordered_json RunPage::events(std::size_t budget_bytes, std::vector<std::string>& remarks) const {
  // Of interventions after the last moment nothing is known.
  std::size_t count = events_.size();
  while (count > 0 && events_[count - 1].moment >= times_us_.size()) --count;
  std::size_t left_out = left_out_events_;
  ordered_json all = events(count);
  for (std::size_t bytes; count > 0 && (bytes = packedForPage(textOf(all)).size()) > budget_bytes;) {
    left_out += count;
    count = fewer(count, budget_bytes, bytes);
    left_out -= count;
    all = events(count);
  }
  if (left_out > 0) {
    remarks.push_back("The page contains the first " + withCommas(count) + " messages and interventions; " +
                      withCommas(left_out) + " later ones are left out.");
  }
  return all;
}

std::string RunPage::encodeTracks() const {
  PageBytes bytes;
  for (const auto& robot : robots_) addKeys(robot.track.keys(), true, bytes);
  for (const auto& list : objects_) {
    for (const auto& track : list.tracks) {
      if (track) addKeys(track->keys(), false, bytes);
    }
  }
  return packedForPage(bytes.bytes());
}

std::string RunPage::tracks(const std::function<void(const std::string&)>& progress, std::size_t budget_bytes) {
  progress("poses");
  std::string packed = encodeTracks();
  constexpr std::int64_t kCoarsest_mm = 256;
  while (packed.size() > budget_bytes && tolerance_.position_mm < kCoarsest_mm) {
    tolerance_ = tolerance_.doubled();
    deviation_ += tolerance_.position_mm;
    progress("poses, within " + std::to_string(deviation_ + 1) + " mm");
    for (auto& robot : robots_) robot.track = robot.track.coarser(tolerance_);
    for (auto& list : objects_) {
      for (auto& track : list.tracks) {
        if (track) track = track->coarser(tolerance_);
      }
    }
    packed = encodeTracks();
  }
  return packed;
}

std::string RunPage::encodeStates(std::uint64_t moments) const {
  PageBytes bytes;
  for (const auto& robot : robots_) {
    const auto end = std::partition_point(robot.states.begin(), robot.states.end(),
                                          [&](const StateChange& change) { return change.moment < moments; });
    bytes.add(static_cast<std::uint64_t>(end - robot.states.begin()));
    std::uint64_t moment = 0;
    for (auto change = robot.states.begin(); change != end; ++change) {
      const PageRobotState& state = change->state;
      bytes.add(change->moment - std::exchange(moment, change->moment));
      bytes.add(state.flags());
      bytes.add(state.led_color);
    }
  }
  return packedForPage(bytes.bytes());
}

std::string RunPage::states(std::size_t budget_bytes, std::vector<std::string>& remarks) const {
  std::size_t moments = times_us_.size();
  std::string packed = encodeStates(moments);
  while (packed.size() > budget_bytes && moments > 1) {
    moments = fewer(moments, budget_bytes, packed.size());
    packed = encodeStates(moments);
  }
  if (moments < times_us_.size()) {
    remarks.push_back("States of the robots change too often for a page: it contains them until " +
                      timeText(times_us_[moments]) + "; later ones are left out.");
  }
  return packed;
}

ordered_json RunPage::head() const {
  ordered_json types = ordered_json::array(), robots = ordered_json::array();
  std::optional<Bounds2D> area;
  for (const auto& robot : robots_) {
    robots.push_back(pageRobot(robot.described, types));
    if (world_) continue;
    for (const auto& key : robot.track.keys()) {
      const double x = static_cast<double>(key.x_mm) * PoseTrack::kUnit_m,
                   y = static_cast<double>(key.y_mm) * PoseTrack::kUnit_m;
      if (!area) area = Bounds2D{x, x, y, y};
      *area = {std::min(area->x_min, x), std::max(area->x_max, x), std::min(area->y_min, y), std::max(area->y_max, y)};
    }
  }
  World world;
  if (world_) {
    world = *world_;
  } else {
    const Bounds2D paths = area.value_or(Bounds2D());
    world.bounds = {paths.x_min - kGroundMargin_m, paths.x_max + kGroundMargin_m, paths.y_min - kGroundMargin_m,
                    paths.y_max + kGroundMargin_m};
  }
  ordered_json objects = ordered_json::array();
  for (const auto& list : objects_) {
    ordered_json moving = ordered_json::array();
    for (std::size_t i = 0; i < list.tracks.size(); ++i) {
      if (list.tracks[i]) moving.push_back(i);
    }
    objects.push_back({{"moment", list.moment},
                       {"objects", pageObjects(list.objects.orThose(world_->objects))},
                       {"moving", std::move(moving)}});
  }
  ordered_json facts = ordered_json::array();
  for (const auto& [name, value] : facts_) facts.push_back({name, value});
  return {{"format", 1},
          {"title", title_},
          {"world", pageWorld(world)},
          {"has_world", world_.has_value()},
          {"types", std::move(types)},
          {"robots", std::move(robots)},
          {"objects", std::move(objects)},
          {"events", ordered_json::array()},
          {"facts", std::move(facts)},
          {"hidden", hidden_},
          {"remarks", ordered_json::array()}};
}

std::string RunPage::html(const std::function<void(const std::string&)>& progress) {
  return runPageDocument(title_, blocks(progress));
}

std::vector<PageBlock> RunPage::blocks(const std::function<void(const std::string&)>& progress) {
  const double duration_s = times_us_.empty() ? 0 : static_cast<double>(times_us_.back() - times_us_.front()) * 1e-6;
  const std::size_t budget_bytes = maxBytes(robots_.size(), duration_s) - kProgram_bytes;
  std::vector<PageBlock> blocks;
  blocks.push_back({"tracks", tracks(progress, budget_bytes * 6 / 10)});
  ordered_json head = this->head();
  std::vector<std::string> remarks = remarks_;
  blocks.push_back({"states", states(budget_bytes / 5, remarks)});
  head["events"] = events(budget_bytes / 10, remarks);
  PageBytes times;
  std::int64_t before = 0, difference_before = 0;
  for (const std::int64_t time : times_us_) {
    // Second differences: zero at equal steps.
    const std::int64_t difference = time - std::exchange(before, time);
    times.addSigned(difference - std::exchange(difference_before, difference));
  }
  blocks.push_back({"moments", packedForPage(times.bytes())});
  std::size_t used = 0;
  for (const auto& block : blocks) used += block.text.size();
  used += packedForPage(textOf(head)).size();
  auto readings = readings_.encode(budget_bytes > used ? budget_bytes - used : 0,
                                   [&](const std::string& sensor) { progress("readings of " + sensor); });
  head["readings"] = ordered_json::array();
  for (auto& block : readings) {
    const std::string id = "readings-" + std::to_string(head["readings"].size());
    head["readings"].push_back(std::move(block.head));
    blocks.push_back({id, std::move(block.packed)});
  }
  head["deviation_m"] = static_cast<double>(deviation_ + 1) * PoseTrack::kUnit_m;
  head["deviation_deg"] = static_cast<double>(deviation_ + 1) * PoseTrack::kUnit_deg;
  if (objects_end_us_) {
    remarks.push_back("Objects change too often for a page: it contains their places until " +
                      timeText(*objects_end_us_) + ".");
  }
  if (are_times_limited_)
    remarks.emplace_back("Times more than 71 years after the first are wrong: the page limits them.");
  for (auto& remark : readings_.remarks()) remarks.push_back(std::move(remark));
  head["remarks"] = std::move(remarks);
  blocks.insert(blocks.begin(), {"run", packedForPage(textOf(head))});
  return blocks;
}

}  // namespace robosim
