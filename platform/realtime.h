// SPDX-License-Identifier: Apache-2.0
// What a thread or process may ask of the system to be on time. Each says whether it was granted;
// none is needed to work.
#pragma once

#include <string>

namespace darkling {

// SCHED_FIFO at `priority` for the calling thread; threads it starts are not.
// @param priority  1…99.
// @return empty when granted, else why not and what would grant it.
[[nodiscard]] std::string request_realtime(int priority);

// Keeps the calling thread, and threads it starts later, on one core.
[[nodiscard]] std::string request_core(int cpu);

// Keeps all memory of the process, of now and of later, from being paged out.
[[nodiscard]] std::string lock_memory();

// Names the calling thread, for people who list threads: at most 15 characters count.
void name_thread(const char* name);

}  // namespace darkling
