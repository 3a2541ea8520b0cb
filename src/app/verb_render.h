// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "app/dataset_writer.h"
#include "base/result.h"
#include "drivers/synthetic/synthetic_spec.h"

namespace darkling {

struct RenderOptions {
  SyntheticSpec spec;  // set_synthetic_key() sets its members by name
  std::string folder;  // absent or empty, unless `is_forced`
  DatasetLayout layout = DatasetLayout::kEuroc;
  bool is_forced = false;  // write over an earlier dataset in `folder`
};

// Renders a scene into a dataset that `replay` plays. Every frame on disk is complete and in the
// index before the next begins, so that an interrupted run leaves a shorter dataset.
// @return the exit status, kInterruptedStatus when a signal cut it short; kUsage when the options
//         make no sense or the folder is not to be written to, before anything is rendered.
[[nodiscard]] Result<int> run_render(const RenderOptions& options);

}  // namespace darkling
