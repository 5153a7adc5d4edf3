// Protocol v1 must stay compatible with its description in tests/data/robosim_v1.binpb: clients of other versions rely
// on the number, type, name and label of every field. Additions are permitted, and must be stored: the test would not
// protect them otherwise.
#include <algorithm>
#include <filesystem>
#include <fstream>

#include <google/protobuf/descriptor.h>
#include <google/protobuf/descriptor.pb.h>
#include <gtest/gtest.h>

#include "robosim/v1/control_panel.pb.h"
#include "robosim/v1/error.pb.h"
#include "robosim/v1/remote_control.pb.h"
#include "robosim/v1/viewing.pb.h"

namespace robosim {
namespace {

using namespace google::protobuf;

/// Compares stored descriptions with the current ones of a pool.
class Comparison {
 public:
  explicit Comparison(const FileDescriptorSet& stored, const DescriptorPool& pool = *DescriptorPool::generated_pool())
      : pool_(pool) {
    for (const auto& file : stored.file()) {
      for (const auto& message : file.message_type()) compareMessage(file.package(), message);
      for (const auto& type : file.enum_type()) compareEnum(file.package(), type);
      for (const auto& service : file.service()) compareService(file.package(), service);
    }
  }
  /// What has changed or disappeared.
  const std::vector<std::string>& differences() const { return differences_; }
  std::size_t fields() const { return fields_; }

 private:
  void compareMessage(const std::string& scope, const DescriptorProto& stored) {
    const std::string name = scope + "." + stored.name();
    const Descriptor* current = pool_.FindMessageTypeByName(name);
    if (!current) {
      differences_.push_back(name + " is missing");
      return;
    }
    for (const auto& field : stored.field()) compareField(name, stored, field, *current);
    for (const auto& nested : stored.nested_type()) compareMessage(name, nested);
    for (const auto& type : stored.enum_type()) compareEnum(name, type);
  }

  void compareField(const std::string& scope, const DescriptorProto& message, const FieldDescriptorProto& stored,
                    const Descriptor& now) {
    ++fields_;
    const std::string name = scope + "." + stored.name();
    const FieldDescriptor* field = now.FindFieldByNumber(stored.number());
    if (!field || field->name() != stored.name()) {
      differences_.push_back(name + " = " + std::to_string(stored.number()) + " is missing");
      return;
    }
    FieldDescriptorProto current;
    field->CopyTo(&current);
    if (current.type() != stored.type() || current.type_name() != stored.type_name()) {
      differences_.push_back(name + " has another type");
    }
    if (current.label() != stored.label() || current.proto3_optional() != stored.proto3_optional()) {
      differences_.push_back(name + " has another label");
    }
    const std::string oneof = stored.has_oneof_index() ? message.oneof_decl(stored.oneof_index()).name() : "";
    if ((field->containing_oneof() ? field->containing_oneof()->name() : "") != oneof) {
      differences_.push_back(name + " is in another oneof");
    }
  }

  void compareEnum(const std::string& scope, const EnumDescriptorProto& stored) {
    const std::string name = scope + "." + stored.name();
    const EnumDescriptor* current = pool_.FindEnumTypeByName(name);
    for (const auto& value : stored.value()) {
      const auto* now = current ? current->FindValueByNumber(value.number()) : nullptr;
      if (!now || now->name() != value.name()) differences_.push_back(name + "." + value.name() + " is missing");
    }
  }

  void compareService(const std::string& scope, const ServiceDescriptorProto& stored) {
    const std::string name = scope + "." + stored.name();
    const ServiceDescriptor* current = pool_.FindServiceByName(name);
    for (const auto& method : stored.method()) {
      const MethodDescriptor* now = current ? current->FindMethodByName(method.name()) : nullptr;
      MethodDescriptorProto current_method;
      if (now) now->CopyTo(&current_method);
      if (!now || current_method.input_type() != method.input_type() ||
          current_method.output_type() != method.output_type() ||
          current_method.client_streaming() != method.client_streaming() ||
          current_method.server_streaming() != method.server_streaming()) {
        differences_.push_back(name + "." + method.name() + " is missing or has changed");
      }
    }
  }

  const DescriptorPool& pool_;
  std::vector<std::string> differences_;
  std::size_t fields_ = 0;
};

FileDescriptorSet storedProtocol() {
  // Each file is registered when a message of it is used.
  for (const auto* message : {v1::RunStatus::descriptor(), v1::ErrorDetail::descriptor(),
                              v1::ControlRequest::descriptor(), v1::Frame::descriptor()}) {
    EXPECT_NE(message, nullptr);
  }
  FileDescriptorSet stored;
  std::ifstream in(ROBOSIM_SOURCE_DIR "/tests/data/robosim_v1.binpb", std::ios::binary);
  EXPECT_TRUE(stored.ParseFromIstream(&in));
  return stored;
}

DescriptorProto& messageNamed(FileDescriptorSet& set, const std::string& name) {
  for (auto& file : *set.mutable_file()) {
    for (auto& message : *file.mutable_message_type()) {
      if (message.name() == name) return message;
    }
  }
  throw std::runtime_error("no message " + name);
}

using Differences = std::vector<std::string>;

/// The files of robosim.v1, as compiled into this program.
FileDescriptorSet currentProtocol() {
  FileDescriptorSet current;
  for (const auto& entry :
       std::filesystem::directory_iterator(ROBOSIM_SOURCE_DIR "/lib/foundation/net/proto/robosim/v1")) {
    const std::string name = "robosim/v1/" + entry.path().filename().string();
    const FileDescriptor* const file = DescriptorPool::generated_pool()->FindFileByName(name);
    EXPECT_NE(file, nullptr) << name;
    if (file) file->CopyTo(current.add_file());
  }
  return current;
}

/// What the current protocol has in addition to a stored one.
std::vector<std::string> additionsTo(const FileDescriptorSet& stored) {
  DescriptorPool pool;
  FileDescriptorProto any;
  DescriptorPool::generated_pool()->FindFileByName("google/protobuf/any.proto")->CopyTo(&any);
  pool.BuildFile(any);
  // A file can be added after those that it imports: at least one in each round.
  for (int round = 0; round < stored.file_size(); ++round) {
    for (const auto& file : stored.file()) {
      const auto& imports = file.dependency();
      const bool is_ready = std::all_of(imports.begin(), imports.end(),
                                        [&](const std::string& name) { return pool.FindFileByName(name) != nullptr; });
      if (is_ready && !pool.FindFileByName(file.name())) pool.BuildFile(file);
    }
  }
  return Comparison(currentProtocol(), pool).differences();
}

TEST(ProtocolCompatibility, HasNoChangeOfAStoredFieldEnumOrMethod) {
  const Comparison comparison(storedProtocol());
  EXPECT_EQ(comparison.differences(), Differences{})
      << "clients of other versions rely on these; add a field with a new number instead";
  EXPECT_GT(comparison.fields(), 150u);
}

TEST(ProtocolCompatibility, HasStoredEveryAddition) {
  EXPECT_EQ(additionsTo(storedProtocol()), Differences{})
      << "not stored, and therefore not protected: run cmake --build --preset release --target store_protocol";
}

TEST(ProtocolCompatibility, DetectsAFieldMessageEnumValueAndMethodThatIsNotStored) {
  FileDescriptorSet stored = storedProtocol();
  messageNamed(stored, "RunStatus").mutable_field()->RemoveLast();
  const auto remove = [](auto& list, const std::string& name) {
    list.erase(std::remove_if(list.begin(), list.end(), [&](const auto& part) { return part.name() == name; }),
               list.end());
  };
  for (auto& file : *stored.mutable_file()) {
    for (auto& type : *file.mutable_enum_type()) remove(*type.mutable_value(), "ACTIVITY_FOUND");
    for (auto& service : *file.mutable_service()) remove(*service.mutable_method(), "Pause");
    remove(*file.mutable_message_type(), "PauseRequest");
  }
  Differences additions = additionsTo(stored);
  std::sort(additions.begin(), additions.end());
  EXPECT_EQ(additions, (Differences{"robosim.v1.Activity.ACTIVITY_FOUND is missing",
                                    "robosim.v1.ControlPanel.Pause is missing or has changed",
                                    "robosim.v1.PauseRequest is missing",
                                    "robosim.v1.RunStatus.recording_failure = 23 is missing"}));
}

TEST(ProtocolCompatibility, DetectsARemovedOrRenumberedField) {
  FileDescriptorSet stored = storedProtocol();
  messageNamed(stored, "Command").mutable_field(0)->set_number(99);
  EXPECT_EQ(Comparison(stored).differences(), Differences{"robosim.v1.Command.speed_mps = 99 is missing"});
}

TEST(ProtocolCompatibility, DetectsAChangedTypeLabelAndOneof) {
  FileDescriptorSet stored = storedProtocol();
  auto& command = messageNamed(stored, "Command");
  command.mutable_field(0)->set_type(FieldDescriptorProto::TYPE_FLOAT);
  command.mutable_field(1)->set_label(FieldDescriptorProto::LABEL_REPEATED);
  messageNamed(stored, "DriveRequest").mutable_field(0)->clear_oneof_index();
  EXPECT_EQ(Comparison(stored).differences(), (Differences{"robosim.v1.DriveRequest.hello is in another oneof",
                                                           "robosim.v1.Command.speed_mps has another type",
                                                           "robosim.v1.Command.turn_radps has another label"}));
}

TEST(ProtocolCompatibility, DetectsARemovedMessageEnumValueAndMethod) {
  FileDescriptorSet stored = storedProtocol();
  auto& file = *stored.mutable_file(0);
  file.add_message_type()->set_name("Gone");
  auto& type = *file.add_enum_type();
  type.set_name("Activity");
  type.add_value()->set_name("ACTIVITY_GONE");
  auto& service = *file.add_service();
  service.set_name("Robots");
  service.add_method()->set_name("Fly");
  EXPECT_EQ(Comparison(stored).differences(),
            (Differences{"robosim.v1.Gone is missing", "robosim.v1.Activity.ACTIVITY_GONE is missing",
                         "robosim.v1.Robots.Fly is missing or has changed"}));
}

}  // namespace
}  // namespace robosim
