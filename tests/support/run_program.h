// SPDX-License-Identifier: Apache-2.0
// Runs a program as a user would, and keeps what it printed.
#pragma once

#include <string>
#include <vector>

#include <sys/types.h>

#include "support/temporary_folder.h"

namespace darkling::test {

struct ProgramResult {
  int status = -1;  // exit status; 128 + signal where one ended it
  std::string out;
  std::string err;
};

// A program that is running. Its standard input is empty.
class RunningProgram {
 public:
  // @param words  the program's path and its arguments. Throws when it cannot be started.
  explicit RunningProgram(const std::vector<std::string>& words);
  ~RunningProgram();  // ends it when it still runs
  RunningProgram(const RunningProgram&) = delete;
  RunningProgram& operator=(const RunningProgram&) = delete;

  void send_signal(int signal_number) const;
  // Waits for its end.
  [[nodiscard]] ProgramResult wait();

 private:
  TemporaryFolder folder_;  // of what it prints
  pid_t pid_ = -1;
};

[[nodiscard]] inline ProgramResult run_program(const std::vector<std::string>& words) {
  return RunningProgram(words).wait();
}

}  // namespace darkling::test
