#include "net/dial.h"

namespace robosim {
namespace {

std::string told(const grpc::Status& status, const std::string& address) {
  switch (status.error_code()) {
    case grpc::StatusCode::UNAVAILABLE:
      return "no environment answers at " + address + " (" + status.error_message() +
             "); is 'robosim serve' running, and is this its address?";
    default:
      return "the environment at " + address + ": " + status.error_message();
  }
}

}  // namespace

ConnectionError::ConnectionError(const grpc::Status& status, const std::string& address)
    : std::runtime_error(told(status, address)), code_(status.error_code()) {}

std::shared_ptr<grpc::Channel> dial(const DialOptions& options) {
  grpc::ChannelArguments arguments;
  arguments.SetMaxReceiveMessageSize(-1);  // what the environment sends is as large as its world
  return grpc::CreateCustomChannel(options.address, grpc::InsecureChannelCredentials(), arguments);
}

}  // namespace robosim
