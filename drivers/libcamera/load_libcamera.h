// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/result.h"
#include "drivers/libcamera/request_camera.h"

namespace darkling {

// Loads the module that links libcamera, at the first call; it stays. A service without such a
// camera is spared 6 MB and two threads, 28 MB where memory is locked, which the libraries take
// from the moment they are loaded.
// @return kConfiguration when this program was built without, or the module or one of the libraries
//   that it needs is missing.
// Thread: one at a time.
[[nodiscard]] Result<LibcameraCalls*> load_libcamera();

}  // namespace darkling
