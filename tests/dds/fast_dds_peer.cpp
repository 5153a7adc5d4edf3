#include "tests/dds/fast_dds_peer.h"

#include <atomic>
#include <cstring>
#include <map>
#include <mutex>
#include <stdexcept>

#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/DataWriterListener.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/TopicDataType.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>

// Options of AddressSanitizer: Fast DDS 2.9 deletes its listeners of statistics by a type of another size.
// NOLINTNEXTLINE(bugprone-reserved-identifier,readability-identifier-naming): its own name
extern "C" const char* __asan_default_options() { return "new_delete_type_mismatch=0"; }

namespace fast {
namespace {

using namespace eprosima::fastdds::dds;
using Bytes = std::vector<std::uint8_t>;

/// A type whose samples are encoded messages with the header of CDR.
class EncodedType final : public TopicDataType {
 public:
  explicit EncodedType(const std::string& name) {
    setName(name.c_str());
    m_typeSize = 8u << 20;
    m_isGetKeyDefined = false;
    auto_fill_type_information(false);
    auto_fill_type_object(false);
  }
  bool serialize(void* data, eprosima::fastrtps::rtps::SerializedPayload_t* payload) override {
    const Bytes& bytes = *static_cast<Bytes*>(data);
    payload->encapsulation = CDR_LE;
    payload->length = static_cast<std::uint32_t>(bytes.size());
    std::memcpy(payload->data, bytes.data(), bytes.size());
    return true;
  }
  bool deserialize(eprosima::fastrtps::rtps::SerializedPayload_t* payload, void* data) override {
    static_cast<Bytes*>(data)->assign(payload->data, payload->data + payload->length);
    return true;
  }
  std::function<std::uint32_t()> getSerializedSizeProvider(void* data) override {
    return [data] { return static_cast<std::uint32_t>(static_cast<Bytes*>(data)->size()); };
  }
  void* createData() override { return new Bytes; }
  void deleteData(void* data) override { delete static_cast<Bytes*>(data); }
  bool getKey(void*, eprosima::fastrtps::rtps::InstanceHandle_t*, bool) override { return false; }
};

template <typename Q>
void set(Q& qos, const Qos& wanted) {
  qos.history().kind = KEEP_LAST_HISTORY_QOS;
  qos.history().depth = wanted.depth;
  qos.reliability().kind = wanted.is_reliable ? RELIABLE_RELIABILITY_QOS : BEST_EFFORT_RELIABILITY_QOS;
  qos.durability().kind = wanted.is_transient_local ? TRANSIENT_LOCAL_DURABILITY_QOS : VOLATILE_DURABILITY_QOS;
  qos.endpoint().history_memory_policy =
      eprosima::fastrtps::rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;  // as rmw_fastrtps
}

}  // namespace

struct Peer::Impl {
  DomainParticipant* participant = nullptr;
  Publisher* publisher = nullptr;
  Subscriber* subscriber = nullptr;
  std::map<std::pair<std::string, std::string>, Topic*> topics;

  class Writer final : public Endpoint, DataWriterListener {
   public:
    Writer(Publisher* publisher, Topic* topic, const Qos& qos) : publisher_(publisher) {
      DataWriterQos made = DATAWRITER_QOS_DEFAULT;
      set(made, qos);
      made.publish_mode().kind = ASYNCHRONOUS_PUBLISH_MODE;  // as rmw_fastrtps: messages in fragments need it
      writer_ = publisher->create_datawriter(topic, made, this, StatusMask::publication_matched());
      if (!writer_) throw std::runtime_error("no writer");
    }
    ~Writer() override { publisher_->delete_datawriter(writer_); }
    int matched() const override { return matched_; }
    void write(const Bytes& message) override {
      Bytes sent = message;  // Fast DDS takes what is not constant
      writer_->write(&sent);
    }
    void on_publication_matched(DataWriter*, const PublicationMatchedStatus& status) override {
      matched_ = status.current_count;
    }

   private:
    std::atomic<int> matched_{0};
    Publisher* publisher_;
    DataWriter* writer_;
  };

  class Reader final : public Endpoint, DataReaderListener {
   public:
    Reader(Subscriber* subscriber, Topic* topic, const Qos& qos, OnBytes on_bytes)
        : on_bytes_(std::move(on_bytes)), subscriber_(subscriber) {
      DataReaderQos made = DATAREADER_QOS_DEFAULT;
      set(made, qos);
      reader_ = subscriber->create_datareader(topic, made, this,
                                              StatusMask::data_available() << StatusMask::subscription_matched());
      if (!reader_) throw std::runtime_error("no reader");
    }
    ~Reader() override {
      reader_->set_listener(nullptr);
      subscriber_->delete_datareader(reader_);
    }
    int matched() const override { return matched_; }
    void on_subscription_matched(DataReader*, const SubscriptionMatchedStatus& status) override {
      matched_ = status.current_count;
    }
    void on_data_available(DataReader* reader) override {
      Bytes bytes;
      SampleInfo info;
      while (reader->take_next_sample(&bytes, &info) == ReturnCode_t::RETCODE_OK) {
        if (info.valid_data) on_bytes_(bytes);
      }
    }

   private:
    OnBytes on_bytes_;
    std::atomic<int> matched_{0};
    Subscriber* subscriber_;
    DataReader* reader_;
  };

  Topic* topic(const std::string& name, const std::string& type) {
    Topic*& made = topics[{name, type}];
    if (made) return made;
    TypeSupport(new EncodedType(type)).register_type(participant);
    made = participant->create_topic(name, type, TOPIC_QOS_DEFAULT);
    if (!made) throw std::runtime_error("no topic " + name);
    return made;
  }
};

Peer::Peer(int domain) : impl_(std::make_unique<Impl>()) {
  impl_->participant = DomainParticipantFactory::get_instance()->create_participant(static_cast<DomainId_t>(domain),
                                                                                    PARTICIPANT_QOS_DEFAULT);
  if (!impl_->participant) throw std::runtime_error("Fast DDS cannot join the domain");
  impl_->publisher = impl_->participant->create_publisher(PUBLISHER_QOS_DEFAULT);
  impl_->subscriber = impl_->participant->create_subscriber(SUBSCRIBER_QOS_DEFAULT);
}

Peer::~Peer() {
  impl_->participant->delete_contained_entities();
  DomainParticipantFactory::get_instance()->delete_participant(impl_->participant);
}

std::unique_ptr<Peer::Endpoint> Peer::writer(const std::string& topic, const std::string& type, const Qos& qos) {
  return std::make_unique<Impl::Writer>(impl_->publisher, impl_->topic(topic, type), qos);
}

std::unique_ptr<Peer::Endpoint> Peer::reader(const std::string& topic, const std::string& type, const Qos& qos,
                                             OnBytes on_bytes) {
  return std::make_unique<Impl::Reader>(impl_->subscriber, impl_->topic(topic, type), qos, std::move(on_bytes));
}

}  // namespace fast
