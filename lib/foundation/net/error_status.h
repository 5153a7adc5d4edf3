#pragma once
#include <optional>
#include <string>

#include <grpcpp/support/status.h>

#include "robosim/v1/error.pb.h"

namespace robosim {

/// @file
/// Machine-readable error details of a grpc::Status (error.proto). They are sent in the trailer
/// grpc-status-details-bin, in the format of google.rpc.Status, so that standard tools decode them.

/// The status for an error: the code that doc/protocol.md assigns to the reason, the text, printable (printableLines())
/// and truncated, and the details, which contain the same text: standard clients require that both are equal, and
/// UTF-8.
/// @param robot name of the robot concerned; empty for none
grpc::Status errorStatus(v1::ErrorReason reason, const std::string& text, const std::string& robot = "");

/// The details of a status; nullopt for a status without details, which gRPC itself has created.
std::optional<v1::ErrorDetail> detailOf(const grpc::Status& status);
/// The reason in the details; ERROR_REASON_UNSPECIFIED if there is none.
v1::ErrorReason reasonOf(const grpc::Status& status);

/// Whether the same call may succeed later without other changes: as the details state, and otherwise for the codes of
/// a lost connection.
bool isTransient(const grpc::Status& status);

/// A text shortened to 1000 bytes at a UTF-8 boundary.
std::string truncatedForStatus(const std::string& text);

}  // namespace robosim
