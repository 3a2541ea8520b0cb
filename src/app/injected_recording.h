// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "drivers/frame_source.h"
#include "drivers/injection/injection.h"
#include "geometry/stereo_rig.h"

namespace CLI {  // NOLINT(readability-identifier-naming): a name of CLI11
class App;
}

namespace darkling {

// Declares the repeatable --inject, whose texts parse_injections() understands.
void declare_inject_option(CLI::App& command, std::vector<std::string>& texts);

// Two paragraphs for the help of a command: how an injection is written, and all there are.
[[nodiscard]] std::string describe_inject_option();

// @return `source` with the injections put in; itself where there are none.
// @pre the images are of the size that `rig` is for.
[[nodiscard]] std::unique_ptr<FrameSource> inject_into(std::unique_ptr<FrameSource> source,
                                                       const StereoRig& rig,
                                                       const std::vector<Injection>& injections);

// "run.lcmlog --inject gain=2": what a recording is of.
[[nodiscard]] std::string name_injected(const std::string& source,
                                        const std::vector<Injection>& injections);

}  // namespace darkling
