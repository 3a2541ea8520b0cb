// SPDX-License-Identifier: Apache-2.0
#include "support/project_folder.h"

namespace darkling::test {

std::string project_folder() {
  return DARKLING_PROJECT_DIR;
}

}  // namespace darkling::test
