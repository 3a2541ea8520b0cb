// SPDX-License-Identifier: Apache-2.0
// What the service tells people: one line for every change of state, none for a frame. To the
// journal when systemd started it, else to standard error.
#pragma once

#include <string>

namespace darkling {

void report_info(const std::string& line);
void report_warning(const std::string& line);
void report_error(const std::string& line);

// Tells that something asked of the system was granted, or why not.
// @param refusal  empty: granted.
void report_wish(const std::string& key, const std::string& refusal);

}  // namespace darkling
