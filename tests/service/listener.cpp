// SPDX-License-Identifier: Apache-2.0
#include "service/listener.h"

#include <array>
#include <atomic>
#include <span>
#include <stdexcept>

#include <lcm/lcm-cpp.hpp>
#include <unistd.h>

#include "messages/channels.h"
#include "messages/command_t.hpp"
#include "messages/hint_t.hpp"
#include "messages/wire.h"
#include "platform/clocks.h"

namespace darkling::test {

std::string new_lcm_url() {
  static std::atomic<int> count = 0;
  constexpr int kFirstPort = 20000;
  constexpr int kPorts = 20000;
  const int port = kFirstPort + (getpid() * 7 + count++) % kPorts;
  return "udpm://239.255.76.67:" + std::to_string(port) + "?ttl=0";
}

struct Listener::Network {
  explicit Network(const std::string& url) : lcm(url) {}

  template <class Message, std::vector<Message> Heard::*Kept>
  void keep(const std::string& channel) {
    const auto handle = [](const lcm::ReceiveBuffer*, const std::string&, const Message* message,
                           Network* network) {
      const std::lock_guard lock(network->mutex);
      (network->heard.*Kept).push_back(*message);
    };
    lcm.subscribeFunction<Message, Network*>(channel, handle, this)->setQueueCapacity(1000);
  }

  lcm::LCM lcm;
  mutable std::mutex mutex;
  Heard heard;
  std::atomic<bool> is_stopping = false;
  std::thread thread;
};

Listener::Listener(const std::string& url, const std::string& prefix)
    : network_(std::make_unique<Network>(url)) {
  if (!network_->lcm.good()) throw std::runtime_error(url + ": no network");
  network_->keep<update_t, &Heard::updates>(prefix + "VO_UPDATE");
  network_->keep<pose_t, &Heard::poses>(prefix + "VO_POSE");
  network_->keep<status_t, &Heard::statuses>(prefix + "VO_STATUS");
  network_->thread = std::thread([network = network_.get()] {
    while (!network->is_stopping) network->lcm.handleTimeout(50);
  });
}

Listener::~Listener() {
  network_->is_stopping = true;
  network_->thread.join();
}

Heard Listener::heard() const {
  const std::lock_guard lock(network_->mutex);
  return network_->heard;
}

bool Listener::wait_until(const std::function<bool(const Heard&)>& is_so,
                          std::chrono::milliseconds timeout) const {
  const auto until = std::chrono::steady_clock::now() + timeout;
  do {
    {
      const std::lock_guard lock(network_->mutex);
      if (is_so(network_->heard)) return true;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  } while (std::chrono::steady_clock::now() < until);
  return false;
}

void Listener::send(const std::string& channel, const void* bytes, std::size_t size) {
  network_->lcm.publish(channel, bytes, static_cast<unsigned>(size));
}

void Listener::send_command(std::int8_t command) {
  command_t message = {};
  message.command = command;
  std::array<std::byte, 64> bytes;
  send(kCommandChannel, bytes.data(), encode_into(std::span(bytes), message));
}

void Listener::send_hint() {
  hint_t message = {};
  message.utime_to = to_ns(read_epoch_clock()) / 1000;
  message.utime_from = message.utime_to - 50'000;
  message.rotation[0] = 1.0;
  message.valid_for_ms = 1000;
  std::array<std::byte, 128> bytes;
  send(kHintChannel, bytes.data(), encode_into(std::span(bytes), message));
}

}  // namespace darkling::test
