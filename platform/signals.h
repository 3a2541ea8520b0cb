// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace darkling {

// From now on SIGINT and SIGTERM ask for a clean stop; a second one of them ends the process at
// once, as if it had never been caught. Call once, from the main thread.
void catch_stop_signals();

// Whether a stop was asked for. Thread: any.
[[nodiscard]] bool is_stop_requested();

// From now on SIGHUP asks for the configuration to be read again. Call once, from the main thread.
void catch_reload_signal();

// Whether that was asked for since the last call. Thread: one.
[[nodiscard]] bool take_reload_request();

}  // namespace darkling
