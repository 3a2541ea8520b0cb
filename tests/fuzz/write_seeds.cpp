// SPDX-License-Identifier: Apache-2.0
// write_seeds DIR: what the fuzzers start from, DIR/frame_log and DIR/messages.
#include <cstdio>

#include "support/message_cases.h"
#include "support/temporary_folder.h"
#include "support/tiny_frame_log.h"

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("write_seeds DIR\n", stderr);
    return 64;
  }
  using namespace darkling;  // NOLINT(google-build-using-namespace)
  const std::string folder = argv[1];
  test::write_text(folder + "/frame_log/empty.lcmlog", "");  // makes the folder
  test::write_tiny_frame_log(folder + "/frame_log/tiny.lcmlog");
  for_each_message([&](const auto& message) {
    const std::vector<std::byte> bytes = encoded(message);
    test::write_text(folder + "/messages/" + message.getTypeName(),
                     {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  });
  return 0;
}
