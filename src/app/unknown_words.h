// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "base/result.h"

namespace CLI {  // NOLINT(readability-identifier-naming): a name of CLI11
class App;
}

namespace darkling {

// Looks for verbs and options that `app` does not have, before it parses `words`: its own messages
// name no neighbours.
// @return kUsage for the first unknown word, with the nearest known one.
[[nodiscard]] Result<void> check_words(const CLI::App& app, const std::vector<std::string>& words);

}  // namespace darkling
