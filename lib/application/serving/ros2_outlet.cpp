#include "serving/ros2_outlet.h"

#include <algorithm>
#include <utility>

#include "base/error_list.h"

namespace robosim {

std::string ros2Namespace(const std::string& text) {
  if (text.empty() || text == "/") return "";
  const std::string name = text.front() == '/' ? text : "/" + text;
  char before = 0;
  bool is_valid = name.back() != '/';
  for (const char c : name) {
    const bool is_letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
    const bool is_digit = c >= '0' && c <= '9';
    is_valid = is_valid && (is_letter || (is_digit && before != '/') || (c == '/' && before != '/'));
    before = c;
  }
  if (!is_valid) {
    throw ConfigError("--namespace " + text + ": must consist of letters, digits and _, with / between parts that do " +
                      "not begin with a digit, as in team1 or /lab/team1");
  }
  return name;
}

std::string ros2TopicName(const std::string& name_space, const std::string& topic) {
  const bool is_common = topic == "/clock" || topic == "/tf" || topic == "/tf_static";
  return is_common ? topic : name_space + topic;
}

void Ros2Outlet::offer(const std::vector<Topic>& topics, bool is_another_run) {
  std::map<std::string, Sent> former = std::exchange(sent_, {});
  of_topic_.clear();
  for (const auto& topic : topics) {
    if (topic.name.ends_with("/cmd_vel")) {
      of_topic_.push_back(nullptr);
      continue;
    }
    Sent& sent = sent_[topic.name];
    if (const auto found = former.find(topic.name); found != former.end() && found->second.topic == topic) {
      sent = std::move(found->second);
      if (is_another_run) sent.arrivals = 0;
    } else {
      sent.topic = topic;
      Topic named = topic;
      named.name = ros2TopicName(name_space_, topic.name);
      sent.writer = participant_.write(named);
    }
    of_topic_.push_back(&sent);
  }
  // Elsewhere: each end of a writer takes about 1 ms, which Cyclone DDS spends waiting.
  std::erase_if(former, [](const auto& entry) { return !entry.second.writer; });
  if (former.empty()) return;
  ending_ = std::async(std::launch::async, [ended = std::move(former)]() mutable { ended.clear(); });
}

bool Ros2Outlet::wants(std::size_t topic, Audience audience) const {
  const Sent* const sent = of_topic_[topic];
  if (!sent) return false;
  return audience == Audience::all ? sent->writer->readers() > 0 : sent->isLatched() && sent->in_round > sent->arrivals;
}

bool Ros2Outlet::isSubscribed(std::size_t topic) const { return wants(topic, Audience::all); }

bool Ros2Outlet::hasFresh() const {
  return std::any_of(sent_.begin(), sent_.end(), [](const auto& entry) {
    const Sent& sent = entry.second;
    return sent.isLatched() && sent.writer->arrivals() > sent.arrivals;
  });
}

void Ros2Outlet::beginRound(std::uint64_t /*time_ns*/) {
  for (auto& [name, sent] : sent_) sent.in_round = sent.writer->arrivals();
}

void Ros2Outlet::send(std::size_t topic, Audience /*audience*/, std::uint64_t /*time_ns*/,
                      std::vector<std::uint8_t> message, bool /*latest_only*/) {
  of_topic_[topic]->writer->write(std::move(message));
}

void Ros2Outlet::endRound() {
  for (auto& [name, sent] : sent_) sent.arrivals = sent.in_round;
}

}  // namespace robosim
