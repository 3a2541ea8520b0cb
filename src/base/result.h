// SPDX-License-Identifier: Apache-2.0
// Results of what the world can make fail at start-up: a value, or an error a person can act on.
#pragma once

#include <string>
#include <utility>

#include <tl/expected.hpp>

namespace darkling {

// Process exit codes (sysexits.h where it has one); the number is the contract with scripts.
enum class ExitCode : int {
  kDone = 0,
  kUsage = 64,              // an option or argument is wrong
  kBadInput = 65,           // input that makes no sense
  kNoInput = 66,            // input absent or unreadable
  kDeviceUnavailable = 69,  // no camera, or it is taken
  kInternal = 70,           // our own fault
  kConfiguration = 78,      // configuration or calibration
};

struct [[nodiscard]] Error {
  ExitCode code = ExitCode::kInternal;
  // One or more lines: file, line and key; what was found; what is allowed; what to do.
  std::string message;
};

template <class T>
using Result = tl::expected<T, Error>;

// Makes the failing side of a Result: `return failure(ExitCode::kNoInput, "…");`
inline tl::unexpected<Error> failure(ExitCode code, std::string message) {
  return tl::unexpected<Error>(Error{code, std::move(message)});
}

}  // namespace darkling
