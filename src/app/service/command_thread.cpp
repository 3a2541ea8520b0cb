// SPDX-License-Identifier: Apache-2.0
#include "app/service/command_thread.h"

#include <memory>
#include <utility>

#include <lcm/lcm.h>

#include "app/service/understand_wish.h"
#include "messages/channel_pattern.h"
#include "messages/channels.h"
#include "platform/clocks.h"
#include "platform/realtime.h"

namespace darkling {

namespace {

constexpr int kWait_ms = 100;
constexpr Duration kBackOff = std::chrono::seconds(2);

struct LcmCloser {
  void operator()(lcm_t* lcm) const { lcm_destroy(lcm); }
};

std::span<const std::byte> bytes_of(const lcm_recv_buf_t* received) {
  return {static_cast<const std::byte*>(received->data), received->data_size};
}

}  // namespace

// One connection, and what LCM calls back.
class CommandThread::Listener {
 public:
  explicit Listener(CommandThread& thread) : thread_(thread) {
    lcm_.reset(lcm_create(thread.lcm_url_.c_str()));
    if (lcm_ == nullptr) return;
    const auto listen = [&](const char* channel, lcm_msg_handler_t handler) {
      const std::string name = escape_channel(thread.channel_prefix_) + channel;
      lcm_subscribe(lcm_.get(), name.c_str(), handler, &thread_);
    };
    listen(kCommandChannel, &Listener::on_command);
    listen(kHintChannel, &Listener::on_hint);
  }

  // @return false when there is no connection, or it has broken.
  bool listen() { return lcm_ != nullptr && lcm_handle_timeout(lcm_.get(), kWait_ms) >= 0; }

 private:
  static void on_command(const lcm_recv_buf_t* received, const char*, void* user) {
    auto& thread = *static_cast<CommandThread*>(user);
    const auto command = understand_command(bytes_of(received));
    if (!command) {
      ++thread.malformed_;
    } else if (const Wish wish = to_wish(*command); wish.kind != Wish::Kind::kNone) {
      static_cast<void>(thread.links_.wishes.try_push(Wish(wish)));
    } else {
      thread.links_.on_command(command->command);
    }
  }

  static void on_hint(const lcm_recv_buf_t* received, const char*, void* user) {
    auto& thread = *static_cast<CommandThread*>(user);
    auto wish = understand_hint(bytes_of(received), read_epoch_clock());
    if (!wish) {
      ++thread.malformed_;
      return;
    }
    static_cast<void>(thread.links_.wishes.try_push(std::move(*wish)));
  }

  CommandThread& thread_;
  std::unique_ptr<lcm_t, LcmCloser> lcm_;
};

CommandThread::CommandThread(Links links, const std::string& lcm_url,
                             const std::string& channel_prefix)
    : links_(std::move(links)),
      lcm_url_(lcm_url),
      channel_prefix_(channel_prefix),
      thread_([this] { serve(); }) {}

CommandThread::~CommandThread() {
  is_stopping_ = true;
  thread_.join();
}

void CommandThread::serve() {
  name_thread("commands");
  while (!is_stopping_) {
    Listener listener(*this);
    while (!is_stopping_ && listener.listen()) continue;
    const MonotonicTime again_at = read_monotonic_clock() + kBackOff;
    while (!is_stopping_ && read_monotonic_clock() < again_at) {
      static_cast<void>(sleep_until(read_monotonic_clock() + std::chrono::milliseconds(kWait_ms)));
    }
  }
}

}  // namespace darkling
