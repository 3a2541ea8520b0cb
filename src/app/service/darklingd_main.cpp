// SPDX-License-Identifier: Apache-2.0
#include "app/service/service_command_line.h"

int main(int argc, char** argv) {
  return darkling::run_service_command_line(argc, argv);
}
