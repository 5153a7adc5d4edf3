#include "net/error_status.h"

#include <gtest/gtest.h>

namespace robosim {
namespace {

TEST(ErrorStatus, AssignsACodeToEveryReason) {
  for (int i = v1::ErrorReason_MIN + 1; i <= v1::ErrorReason_MAX; ++i) {
    const auto reason = static_cast<v1::ErrorReason>(i);
    const grpc::Status status = errorStatus(reason, "text");
    EXPECT_NE(status.error_code(), grpc::StatusCode::OK) << i;
    EXPECT_NE(status.error_code(), grpc::StatusCode::UNKNOWN) << v1::ErrorReason_Name(reason);
    EXPECT_EQ(reasonOf(status), reason);
  }
}

TEST(ErrorStatus, ContainsTheDetails) {
  const grpc::Status status = errorStatus(v1::ERROR_REASON_ROBOT_TAKEN, "robot 'Anna' is taken", "Anna");
  EXPECT_EQ(status.error_code(), grpc::StatusCode::ALREADY_EXISTS);
  EXPECT_EQ(status.error_message(), "robot 'Anna' is taken");
  const auto detail = detailOf(status);
  ASSERT_TRUE(detail.has_value());
  EXPECT_EQ(detail->robot(), "Anna");
  EXPECT_TRUE(detail->is_transient());
}

TEST(ErrorStatus, HasTheFormatOfGoogleRpcStatus) {
  v1::ErrorStatus sent;
  ASSERT_TRUE(sent.ParseFromString(errorStatus(v1::ERROR_REASON_UNKNOWN_ROBOT, "text").error_details()));
  EXPECT_EQ(sent.code(), grpc::StatusCode::NOT_FOUND);
  EXPECT_EQ(sent.message(), "text") << "standard clients compare it with the status's message";
  ASSERT_EQ(sent.details_size(), 1);
  EXPECT_EQ(sent.details(0).type_url(), "type.googleapis.com/robosim.v1.ErrorDetail");
}

TEST(ErrorStatus, OfGrpcItselfHasNoReason) {
  EXPECT_EQ(reasonOf({grpc::StatusCode::UNAVAILABLE, "no connection"}), v1::ERROR_REASON_UNSPECIFIED);
  EXPECT_EQ(reasonOf({grpc::StatusCode::UNAVAILABLE, "no connection", "\xff not a message"}),
            v1::ERROR_REASON_UNSPECIFIED);
}

TEST(ErrorStatus, IsTransientAsTheDetailsStateAndOtherwiseByItsCode) {
  EXPECT_TRUE(isTransient({grpc::StatusCode::UNAVAILABLE, "no connection"}));
  EXPECT_FALSE(isTransient({grpc::StatusCode::INVALID_ARGUMENT, "no"}));
  EXPECT_TRUE(isTransient(errorStatus(v1::ERROR_REASON_STEP_DEADLINE, "late")));
  EXPECT_FALSE(isTransient(errorStatus(v1::ERROR_REASON_WORLD_REPLACED, "another world")));
}

TEST(ErrorStatus, TruncatesTextsAtAUtf8Boundary) {
  EXPECT_EQ(truncatedForStatus("short"), "short");
  std::string text;
  while (text.size() < 3000) text += "é";
  const std::string cut = truncatedForStatus("x" + text);
  EXPECT_EQ(cut, "x" + text.substr(0, 998) + " …") << "the character across byte 1000 is dropped";
}

TEST(ErrorStatus, HasTheSameUtf8TextInItsDetails) {
  for (const std::string& text :
       {std::string("line 1\nline 2"), std::string(5000, 'x'), std::string("\xff\xc3 \x1b[2J é")}) {
    const grpc::Status status = errorStatus(v1::ERROR_REASON_INTERNAL, text);
    v1::ErrorStatus details;
    ASSERT_TRUE(details.ParseFromString(status.error_details())) << text;
    EXPECT_EQ(details.message(), status.error_message());
  }
  EXPECT_EQ(errorStatus(v1::ERROR_REASON_INTERNAL, "line 1\nline 2").error_message(), "line 1\nline 2");
  EXPECT_EQ(errorStatus(v1::ERROR_REASON_INTERNAL, "\xff\xc3 é").error_message(), "\\xff\\xc3 é");
}

TEST(ErrorStatus, FitsIntoTheMetadataOfACall) {
  std::string text;
  while (text.size() < 3000) text += "é";
  const grpc::Status status = errorStatus(v1::ERROR_REASON_UNKNOWN_ROBOT, text, text);
  // gRPC sends each byte of "é" as "%C3", and the details in base 64; the limit is 8 KiB.
  EXPECT_LT(status.error_message().size() * 3 + status.error_details().size() * 4 / 3, 7000u);
}

}  // namespace
}  // namespace robosim
