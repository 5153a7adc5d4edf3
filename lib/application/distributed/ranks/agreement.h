#pragma once
#include <exception>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "distributed/ranks/rank_group.h"

namespace robosim {

/// @file
/// Errors of a program on several ranks: an error on one of them ends all, with one message and one exit code.

/// An exception as bytes, to be sent to other ranks; empty for null. What determines the exit code remains: bad input
/// (ConfigError, std::invalid_argument), Interrupted, or any other.
std::string errorBytes(const std::exception_ptr& error);

/// Throws, if any rank has failed, the error of the first one by rank: the exception itself on that rank; elsewhere one
/// with its text, which names the rank unless it is rank 0. Then isFailureShared().
/// @param errors errorBytes() by rank, the same at every rank @param own exception of this rank; null for none
void throwFirstError(const RankGroup& group, const std::vector<std::string_view>& errors,
                     const std::exception_ptr& own);

/// Executes a function on every rank; a collective operation. Throws on all ranks, as throwFirstError() does, if it
/// throws on any. The first collective operation of a program must be this one: a rank that fails before it takes part
/// with its error.
void agree(RankGroup& group, const std::function<void()>& function);

/// Whether this process has called agree().
bool hasAgreed();
/// Whether all ranks know of the error that ends this one, so that it may end in the ordinary way.
bool isFailureShared();
void setFailureShared();

}  // namespace robosim
