// SPDX-License-Identifier: Apache-2.0
#include "drivers/libcamera/load_libcamera.h"

#include <string>

#include <dlfcn.h>

#include "drivers/libcamera/small_stacks.h"

namespace darkling {

#ifdef DARKLING_HAS_LIBCAMERA

namespace {

// Looked for where the program's own run path says.
constexpr const char* kModule = "darkling_libcamera.so";
constexpr const char* kEntry = "darkling_libcamera_calls";

tl::unexpected<Error> cannot_load() {
  const char* reason = ::dlerror();
  return failure(ExitCode::kConfiguration,
                 std::string("libcamera cannot be used: ") +
                     (reason != nullptr ? reason : "the module is not whole") +
                     "; install the module with the program, and libcamera");
}

}  // namespace

Result<LibcameraCalls*> load_libcamera() {
  const SmallStacks small;
  void* module = ::dlopen(kModule, RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
  if (module == nullptr) return cannot_load();
  void* symbol = ::dlsym(module, kEntry);
  if (symbol == nullptr) return cannot_load();
  const auto entry = reinterpret_cast<LibcameraCalls* (*)()>(symbol);
  return entry();
}

#else

Result<LibcameraCalls*> load_libcamera() {
  return failure(ExitCode::kConfiguration,
                 "built without libcamera, which libcamera: needs; v4l2:/dev/videoN does without, "
                 "or build it where libcamera-dev is installed");
}

#endif

}  // namespace darkling
