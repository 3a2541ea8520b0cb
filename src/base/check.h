// SPDX-License-Identifier: Apache-2.0
// Checks for our own mistakes: on in every build, they report and abort. What the world does wrong
// is a Result (base/result.h) at start-up and a counted status per frame, never a CHECK.
#pragma once

namespace darkling {

// Prints `file:line: CHECK failed: expression (what)` to standard error and aborts.
[[noreturn]] void check_failed(const char* file, int line, const char* expression,
                               const char* what);

}  // namespace darkling

// `what` says the broken rule in words, for the person who reads the journal.
#define CHECK(condition, what) \
  ((condition) ? void(0) : ::darkling::check_failed(__FILE__, __LINE__, #condition, (what)))
