// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "app/top/heard.h"

namespace darkling {

// Every field of the status by its name, `state_name` and `reason_names` besides, and the last
// `pose` and `update`, null when none was heard. Keys are a contract; NaN is null.
// @pre there is a status.
[[nodiscard]] std::string format_heard_json(const Heard& heard);

}  // namespace darkling
