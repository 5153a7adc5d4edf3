#include "dds/cyclone/cyclone_participant.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <exception>
#include <map>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>

#include <dds/dds.h>

#include "base/log_limiter.h"
#include "dds/cyclone/local_sockets.h"
#include "dds/cyclone/opaque_type.h"
#include "dds/cyclone_config.h"
#include "dds/names.h"
#include "dds/send_queue.h"

namespace robosim::dds {
namespace {

using Clock = std::chrono::steady_clock;

/// Takes the warnings and errors that Cyclone DDS logs, for all participants of this process.
class CycloneLog {
 public:
  using Log = std::function<void(const std::string&)>;
  static CycloneLog& instance() {
    static CycloneLog log;
    return log;
  }
  /// Logs by this function, too, until remove(). @param owner identifies it
  void add(const void* owner, Log log) {
    const std::lock_guard lock(mutex_);
    logs_[owner] = std::move(log);
  }
  void remove(const void* owner) {
    const std::lock_guard lock(mutex_);
    logs_.erase(owner);
  }
  /// The last line; empty for none since the last call.
  std::string takeLast() {
    const std::lock_guard lock(mutex_);
    return std::exchange(last_, "");
  }

 private:
  CycloneLog() {
    dds_set_log_mask(DDS_LC_FATAL | DDS_LC_ERROR | DDS_LC_WARNING);
    dds_set_log_sink([](void* log, const dds_log_data_t* data) { static_cast<CycloneLog*>(log)->write(*data); }, this);
  }
  void write(const dds_log_data_t& data) {
    const std::lock_guard lock(mutex_);
    last_.assign(data.message, data.size);
    last_.erase(std::find_if(last_.begin(), last_.end(), [](char c) { return c == '\n' || c == '\0'; }), last_.end());
    for (const auto& [owner, log] : logs_) log("Cyclone DDS: " + last_);
  }

  std::mutex mutex_;
  std::map<const void*, Log> logs_;
  std::string last_;
};

/// Result of a function of Cyclone DDS. @throws std::runtime_error for an error
dds_entity_t checked(dds_entity_t result, const std::string& what) {
  if (result >= 0) return result;
  const std::string why = CycloneLog::instance().takeLast();
  throw std::runtime_error(what + ": " + (why.empty() ? dds_strretcode(result) : why));
}

/// An entity of Cyclone DDS, which is deleted with this.
class Entity {
 public:
  explicit Entity(dds_entity_t id) : id_(id) {}
  ~Entity() { dds_delete(id_); }
  Entity(const Entity&) = delete;
  Entity& operator=(const Entity&) = delete;
  dds_entity_t id() const { return id_; }

 private:
  dds_entity_t id_;
};

using Qos = std::unique_ptr<dds_qos_t, decltype(&dds_delete_qos)>;
using Listener = std::unique_ptr<dds_listener_t, decltype(&dds_delete_listener)>;

/// Qualities of service as rmw_cyclonedds sets them. A writer never waits for a slow reader.
Qos qosOf(const Topic& topic, bool is_reliable) {
  Qos qos(dds_create_qos(), &dds_delete_qos);
  const int depth = topic.depth();
  dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, depth);
  dds_qset_reliability(qos.get(), is_reliable ? DDS_RELIABILITY_RELIABLE : DDS_RELIABILITY_BEST_EFFORT, 0);
  if (topic.delivery == TopicDelivery::latched && is_reliable) {
    dds_qset_durability(qos.get(), DDS_DURABILITY_TRANSIENT_LOCAL);
    dds_qset_durability_service(qos.get(), 0, DDS_HISTORY_KEEP_LAST, depth, DDS_LENGTH_UNLIMITED, DDS_LENGTH_UNLIMITED,
                                DDS_LENGTH_UNLIMITED);
  }
  dds_qset_writer_data_lifecycle(qos.get(), false);
  dds_qset_ignorelocal(qos.get(), DDS_IGNORELOCAL_PARTICIPANT);
  const dds_data_representation_id_t xcdr1 = DDS_DATA_REPRESENTATION_XCDR1;
  dds_qset_data_representation(qos.get(), 1, &xcdr1);
  const std::string hash = "typehash=" + topic.type->hash() + ";";
  dds_qset_userdata(qos.get(), hash.data(), hash.size());
  return qos;
}

/// A domain of this process, which all its participants share.
std::shared_ptr<Entity> domainOf(const Options& options) {
  static std::mutex mutex;
  static std::map<int, std::weak_ptr<Entity>> domains;
  const std::string config = cycloneConfig(options);
  const std::lock_guard lock(mutex);
  CycloneLog::instance().takeLast();
  auto& known = domains[options.domain];
  std::shared_ptr<Entity> domain = known.lock();
  if (!domain) {
    domain = std::make_shared<Entity>(
        checked(dds_create_domain(static_cast<dds_domainid_t>(options.domain), config.c_str()),
                "ROS 2, domain " + std::to_string(options.domain) + ": the network cannot be used"));
    if (options.isLocal()) ignoreOtherMachines(options.domain);
    known = domain;
  }
  return domain;
}

/// What is sent of a writer, also after its end.
struct SentLane final : SendQueue::Lane {
  SentLane(const Topic& sent_topic, std::size_t depth) : Lane(depth), topic(sent_topic) {}
  Topic topic;
  dds_entity_t writer = 0;
  const ddsi_sertype* type = nullptr;                ///< of the topic's entity
  std::optional<std::vector<std::uint8_t>> refused;  ///< a latched message to be sent again; of the sending thread
};

/// Sends what waits, in a thread of its own.
class Sender {
 public:
  explicit Sender(const std::function<void(const std::string&)>& log) : log_(log), thread_([this] { run(); }) {}
  ~Sender() {
    queue_.close();
    thread_.join();
  }
  void push(const std::shared_ptr<SentLane>& lane, std::vector<std::uint8_t> message) {
    if (const auto dropped = queue_.push(lane, std::move(message)); dropped > 0) lose(*lane, dropped);
  }
  /// Waits until the messages of a writer are sent, such as the command by which a robot stops. Once that takes too
  /// long, the later ones of this process do not wait either.
  void awaitSent(const SentLane& lane) {
    if (!is_late_ && !queue_.awaitSent(lane, Clock::now() + kSentMax)) is_late_ = true;
  }
  std::uint64_t lost() const { return lost_; }

 private:
  static constexpr std::chrono::milliseconds kRetryPause{50};
  static constexpr std::chrono::seconds kSentMax{5};

  void run() {
    std::vector<std::shared_ptr<SentLane>> refused;  // lanes
    while (!queue_.isClosed()) {
      const auto until = Clock::now() + (refused.empty() ? std::chrono::milliseconds(1000) : kRetryPause);
      if (auto next = queue_.pop(until)) {
        const auto lane = std::static_pointer_cast<SentLane>(next->lane);
        lane->refused.reset();
        if (!send(*lane, std::move(next->message)) && lane->refused) refused.push_back(lane);
        continue;
      }
      std::erase_if(refused, [this](const std::shared_ptr<SentLane>& lane) {
        if (!lane->refused) return true;
        std::vector<std::uint8_t> message = std::move(*lane->refused);
        lane->refused.reset();
        return send(*lane, std::move(message)) || !lane->refused;
      });
    }
  }

  bool send(SentLane& lane, std::vector<std::uint8_t> message) {
    const bool is_latched = lane.topic.delivery == TopicDelivery::latched;
    std::vector<std::uint8_t> kept;
    if (is_latched) kept = message;
    const dds_return_t result = dds_writecdr(lane.writer, newOpaqueMessage(lane.type, std::move(message)));
    if (result != DDS_RETCODE_TIMEOUT) return true;  // or the writer has ended
    if (is_latched) {
      lane.refused = std::move(kept);
    } else {
      lose(lane, 1);
    }
    return false;
  }

  void lose(const SentLane& lane, std::size_t count) {
    if (lost_.fetch_add(count) == 0) {
      log_("messages of ROS 2 are lost, of " + lane.topic.name + " first: a reader or the network is too slow");
    }
  }

  std::function<void(const std::string&)> log_;
  SendQueue queue_;
  std::atomic<std::uint64_t> lost_{0};
  std::atomic<bool> is_late_{false};
  std::thread thread_;  ///< initialised last: it uses the other members
};

class CycloneWriter final : public Writer {
 public:
  CycloneWriter(dds_entity_t participant, dds_entity_t topic, const ddsi_sertype* type, const Topic& of, Sender& sender)
      : lane_(std::make_shared<SentLane>(of, static_cast<std::size_t>(of.depth()))), sender_(sender) {
    const Listener listener(dds_create_listener(this), &dds_delete_listener);
    dds_lset_publication_matched(listener.get(),
                                 [](dds_entity_t, const dds_publication_matched_status_t status, void* writer) {
                                   static_cast<CycloneWriter*>(writer)->matched(status);
                                 });
    lane_->type = type;
    writer_.emplace(checked(dds_create_writer(participant, topic, qosOf(of, true).get(), listener.get()),
                            "ROS 2: a writer of " + of.name));
    lane_->writer = writer_->id();
  }
  ~CycloneWriter() override { sender_.awaitSent(*lane_); }
  CycloneWriter(const CycloneWriter&) = delete;
  CycloneWriter& operator=(const CycloneWriter&) = delete;
  int readers() const override { return readers_; }
  std::uint64_t arrivals() const override { return arrivals_; }
  void write(std::vector<std::uint8_t> message) override { sender_.push(lane_, std::move(message)); }

 private:
  void matched(const dds_publication_matched_status_t& status) {
    readers_ = static_cast<int>(status.current_count);
    arrivals_ = status.total_count;
  }

  std::atomic<int> readers_{0};
  std::atomic<std::uint64_t> arrivals_{0};
  std::shared_ptr<SentLane> lane_;
  Sender& sender_;
  std::optional<Entity> writer_;
};

class CycloneReader final : public Reader {
 public:
  CycloneReader(dds_entity_t participant, dds_entity_t topic, const Topic& of, Receipt receipt, OnSample on_sample,
                std::shared_ptr<LogLimiter> log)
      : name_(of.name), on_sample_(std::move(on_sample)), log_(std::move(log)) {
    const Listener listener(dds_create_listener(this), &dds_delete_listener);
    dds_lset_subscription_matched(
        listener.get(), [](dds_entity_t, const dds_subscription_matched_status_t status, void* reader) {
          static_cast<CycloneReader*>(reader)->writers_ = static_cast<int>(status.current_count);
        });
    dds_lset_data_available(
        listener.get(), [](dds_entity_t entity, void* reader) { static_cast<CycloneReader*>(reader)->take(entity); });
    reader_.emplace(
        checked(dds_create_reader(participant, topic, qosOf(of, receipt == Receipt::reliable).get(), listener.get()),
                "ROS 2: a reader of " + of.name));
  }
  int writers() const override { return writers_; }

 private:
  void take(dds_entity_t entity) {
    constexpr std::uint32_t kAtOnce = 16;
    ddsi_serdata* messages[kAtOnce];
    dds_sample_info_t infos[kAtOnce];
    for (;;) {
      const dds_return_t count = dds_takecdr(entity, messages, kAtOnce, infos, DDS_ANY_STATE);
      if (count <= 0) return;
      for (dds_return_t i = 0; i < count; ++i) {
        if (infos[i].valid_data) pass({encodedMessage(messages[i]), infos[i].publication_handle});
        ddsi_serdata_unref(messages[i]);
      }
    }
  }
  void pass(const Sample& sample) {
    try {
      on_sample_(sample);
    } catch (const std::exception& error) {
      log_->write("messages of ROS 2", name_ + ": " + error.what());
    }
  }

  std::string name_;
  OnSample on_sample_;
  std::shared_ptr<LogLimiter> log_;
  std::atomic<int> writers_{0};
  std::optional<Entity> reader_;  ///< ended first: its listener uses the other members
};

class CycloneParticipant final : public Participant {
 public:
  explicit CycloneParticipant(const Options& options)
      : domain_(domainOf(options)),
        participant_(join(options.domain)),
        log_(std::make_shared<LogLimiter>(options.log)),
        sender_(options.log) {
    CycloneLog::instance().add(this, options.log);
  }
  ~CycloneParticipant() override { CycloneLog::instance().remove(this); }

  std::unique_ptr<Writer> write(const Topic& topic) override {
    const TopicEntity& entity = entityOf(topic);
    return std::make_unique<CycloneWriter>(participant_.id(), entity.topic->id(), entity.type, topic, sender_);
  }
  std::unique_ptr<Reader> read(const Topic& topic, Receipt receipt, OnSample on_sample) override {
    return std::make_unique<CycloneReader>(participant_.id(), entityOf(topic).topic->id(), topic, receipt,
                                           std::move(on_sample), log_);
  }
  std::uint64_t lost() const override { return sender_.lost(); }

 private:
  struct TopicEntity {
    std::unique_ptr<Entity> topic;
    const ddsi_sertype* type = nullptr;  ///< owned by the entity
  };

  static dds_entity_t join(int domain) {
    const Qos qos(dds_create_qos(), &dds_delete_qos);
    constexpr std::string_view kEnclave = "enclave=/;";
    dds_qset_userdata(qos.get(), kEnclave.data(), kEnclave.size());
    return checked(dds_create_participant(static_cast<dds_domainid_t>(domain), qos.get(), nullptr),
                   "ROS 2, domain " + std::to_string(domain) +
                       ": this program cannot join it, for which it needs one of " + std::to_string(kMaxParticipants) +
                       " free ports");
  }

  const TopicEntity& entityOf(const Topic& topic) {
    const std::lock_guard lock(mutex_);
    TopicEntity& entity = topics_[{topic.name, topic.type->name}];
    if (!entity.topic) {
      ddsi_sertype* type = newOpaqueType(ddsTypeName(topic.type->name));
      const dds_entity_t made = dds_create_topic_sertype(participant_.id(), ddsTopicName(topic.name).c_str(), &type,
                                                         nullptr, nullptr, nullptr);
      if (made < 0) ddsi_sertype_unref(type);
      entity.topic = std::make_unique<Entity>(checked(made, "ROS 2: the topic " + topic.name));
      entity.type = type;
    }
    return entity;
  }

  std::shared_ptr<Entity> domain_;
  Entity participant_;
  std::mutex mutex_;
  std::map<std::pair<std::string, std::string>, TopicEntity> topics_;  ///< by name and type; guarded by the mutex
  std::shared_ptr<LogLimiter> log_;
  Sender sender_;  ///< ended first: it sends by the other members
};

}  // namespace

std::unique_ptr<Participant> joinByCyclone(const Options& options) {
  return std::make_unique<CycloneParticipant>(options);
}

}  // namespace robosim::dds

robosim::dds::Participant* robosimJoinDds(const robosim::dds::Options& options) {
  return robosim::dds::joinByCyclone(options).release();
}
