// SPDX-License-Identifier: Apache-2.0
#include "drivers/synthetic/synthetic_source.h"

#include <cmath>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <vector>

#include "drivers/synthetic/frame_renderer.h"

namespace darkling {

namespace {

using synthetic::Eye;
using synthetic::FrameRenderer;

// Thursday 1 January 2026, 00:00 UTC.
constexpr std::int64_t kStart_ns = 1'767'225'600'000'000'000;

struct Slot {
  enum class State { kFree, kRendering, kReady, kLeased };
  State state = State::kFree;
  std::vector<std::uint8_t> left;
  std::vector<std::uint8_t> right;
};

}  // namespace

struct SyntheticSource::State {
  State(const SyntheticSpec& spec_, int thread_count_)
      : spec(spec_), thread_count(thread_count_), renderer(spec_) {}

  void work();
  static void give_back(void* state, int slot);
  [[nodiscard]] bool is_stuck() const;
  [[nodiscard]] FrameTime stamp(int frame) const {
    return frame_time_from_ns(kStart_ns + std::llround(frame * 1e9 / spec.rate_hz));
  }

  const SyntheticSpec spec;
  const int thread_count;
  const FrameRenderer renderer;

  std::mutex mutex;  // guards what follows
  std::condition_variable changed;
  std::vector<Slot> slots;  // frame k lives in slot k mod size
  std::vector<std::thread> threads;
  int next_to_render = 0;
  int next_to_deliver = 0;
  bool is_stopping = false;
};

void SyntheticSource::State::work() {
  FrameRenderer::Scratch scratch;
  const auto view = [&](std::vector<std::uint8_t>& pixels) {
    return ImageView<std::uint8_t>(pixels.data(), spec.width, spec.height, spec.width);
  };
  std::unique_lock lock(mutex);
  while (true) {
    const auto can_render = [&] {
      return next_to_render < spec.frames &&
             slots[next_to_render % slots.size()].state == Slot::State::kFree;
    };
    changed.wait(lock,
                 [&] { return is_stopping || next_to_render >= spec.frames || can_render(); });
    if (is_stopping || next_to_render >= spec.frames) return;
    const int frame = next_to_render++;
    Slot& slot = slots[frame % slots.size()];
    slot.state = Slot::State::kRendering;
    lock.unlock();
    renderer.render(frame, Eye::kLeft, scratch, view(slot.left));
    renderer.render(frame, Eye::kRight, scratch, view(slot.right));
    lock.lock();
    slot.state = Slot::State::kReady;
    changed.notify_all();
  }
}

void SyntheticSource::State::give_back(void* state, int slot) {
  auto* self = static_cast<State*>(state);
  const std::lock_guard lock(self->mutex);
  self->slots[slot].state = Slot::State::kFree;
  self->changed.notify_all();
}

bool SyntheticSource::State::is_stuck() const {
  return slots[next_to_deliver % slots.size()].state == Slot::State::kLeased;
}

Result<std::unique_ptr<SyntheticSource>> SyntheticSource::create(const SyntheticSpec& spec,
                                                                 int threads) {
  SyntheticSpec checked = spec;
  if (auto ok = check_synthetic(checked); !ok) return tl::unexpected<Error>(ok.error());
  const int cores = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  return std::unique_ptr<SyntheticSource>(
      new SyntheticSource(std::make_unique<State>(checked, threads > 0 ? threads : cores)));
}

SyntheticSource::SyntheticSource(std::unique_ptr<State> state) : state_(std::move(state)) {}

SyntheticSource::~SyntheticSource() {
  stop();
}

Result<void> SyntheticSource::start() {
  CHECK(state_->threads.empty(), "stop() comes before another start()");
  state_->slots.assign(static_cast<std::size_t>(state_->thread_count) + 2, Slot());
  const std::size_t pixels = static_cast<std::size_t>(state_->spec.width) * state_->spec.height;
  for (Slot& slot : state_->slots) {
    slot.left.resize(pixels);
    slot.right.resize(pixels);
  }
  state_->next_to_render = 0;
  state_->next_to_deliver = 0;
  state_->is_stopping = false;
  for (int i = 0; i < state_->thread_count; ++i) {
    state_->threads.emplace_back([state = state_.get()] { state->work(); });
  }
  return {};
}

WaitResult SyntheticSource::wait_next(Duration timeout) {
  std::unique_lock lock(state_->mutex);
  WaitResult result;
  if (state_->slots.empty() || state_->next_to_deliver >= state_->spec.frames) {
    result.status = WaitStatus::kEndOfSource;
    return result;
  }
  const int frame = state_->next_to_deliver;
  const int index = static_cast<int>(frame % state_->slots.size());
  Slot& slot = state_->slots[index];
  const auto is_ready = [&] { return slot.state == Slot::State::kReady; };
  state_->changed.wait_for(lock, timeout, [&] { return !state_->is_stuck(); });
  if (state_->is_stuck()) {
    result.status = WaitStatus::kTimeout;
    return result;
  }
  state_->changed.wait(lock, is_ready);
  slot.state = Slot::State::kLeased;
  ++state_->next_to_deliver;
  const SyntheticSpec& spec = state_->spec;
  const StereoFrame stereo{.sequence = frame,
                           .stamp = state_->stamp(frame),
                           .left = {slot.left.data(), spec.width, spec.height, spec.width},
                           .right = {slot.right.data(), spec.width, spec.height, spec.width}};
  result.status = WaitStatus::kFrame;
  result.lease = FrameLease(stereo, &State::give_back, state_.get(), index);
  return result;
}

void SyntheticSource::stop() {
  {
    const std::lock_guard lock(state_->mutex);
    state_->is_stopping = true;
    state_->changed.notify_all();
  }
  for (std::thread& thread : state_->threads) thread.join();
  state_->threads.clear();
  state_->slots.clear();
}

SourceStats SyntheticSource::stats() const {
  const std::lock_guard lock(state_->mutex);
  return {.delivered = state_->next_to_deliver};
}

const SyntheticSpec& SyntheticSource::spec() const {
  return state_->spec;
}
const StereoRig& SyntheticSource::rig() const {
  return state_->renderer.rig();
}
FrameTime SyntheticSource::stamp(int frame) const {
  return state_->stamp(frame);
}

Se3 SyntheticSource::T_world_body(int frame) const {
  const FrameRenderer& r = state_->renderer;
  return r.T_scene_body(r.time_s(0)).inverse() * r.T_scene_body(r.time_s(frame));
}

}  // namespace darkling
