// SPDX-License-Identifier: Apache-2.0
#include "platform/realtime.h"

#include <cerrno>
#include <cstring>

#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>

namespace darkling {

namespace {

std::string refused(const std::string& wish, int error, const char* remedy) {
  return wish + " was refused: " + std::strerror(error) + "; " + remedy;
}

}  // namespace

std::string request_realtime(int priority) {
  sched_param wanted = {};
  wanted.sched_priority = priority;
  const int error =
      pthread_setschedparam(pthread_self(), SCHED_FIFO | SCHED_RESET_ON_FORK, &wanted);
  if (error == 0) return "";
  return refused("real-time priority " + std::to_string(priority), error,
                 "the unit's LimitRTPRIO= must allow it");
}

std::string request_core(int cpu) {
  if (cpu >= CPU_SETSIZE) return "core " + std::to_string(cpu) + " was refused: no such core";
  cpu_set_t cores;
  CPU_ZERO(&cores);
  CPU_SET(static_cast<unsigned>(cpu), &cores);
  const int error = pthread_setaffinity_np(pthread_self(), sizeof(cores), &cores);
  if (error == 0) return "";
  return refused("core " + std::to_string(cpu), error, "is it there, and allowed to this unit?");
}

std::string lock_memory() {
  if (mlockall(MCL_CURRENT | MCL_FUTURE) == 0) return "";
  return refused("locking memory", errno, "the unit's LimitMEMLOCK= must allow it");
}

void name_thread(const char* name) {
  char shortened[16] = {};
  std::strncpy(shortened, name, sizeof(shortened) - 1);
  static_cast<void>(pthread_setname_np(pthread_self(), shortened));
}

}  // namespace darkling
