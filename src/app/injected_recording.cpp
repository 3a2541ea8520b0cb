// SPDX-License-Identifier: Apache-2.0
#include "app/injected_recording.h"

#include <CLI/CLI.hpp>

#include "drivers/injection/injected_source.h"

namespace darkling {

void declare_inject_option(CLI::App& command, std::vector<std::string>& texts) {
  command.add_option("--inject", texts, "Let something go wrong, repeatable, in order")
      ->type_name("SPEC")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->allow_extra_args(false);
}

std::string describe_inject_option() {
  return "SPEC is NAME[=VALUE][@FIRST:LAST][,seed=N]: what goes wrong in the frames from FIRST up "
         "to but\n"
         "without LAST of SOURCE, counted from 0. The same SPEC gives the same pixels on every "
         "run:\n" +
         describe_injections();
}

std::unique_ptr<FrameSource> inject_into(std::unique_ptr<FrameSource> source, const StereoRig& rig,
                                         const std::vector<Injection>& injections) {
  if (injections.empty()) return source;
  const ImageSize size{.width = rig.left.width, .height = rig.left.height};
  return std::make_unique<InjectedSource>(std::move(source), size, injections);
}

std::string name_injected(const std::string& source, const std::vector<Injection>& injections) {
  std::string name = source;
  for (const Injection& injection : injections) name += " --inject " + injection.text;
  return name;
}

}  // namespace darkling
