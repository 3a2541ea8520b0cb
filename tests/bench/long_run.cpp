// SPDX-License-Identifier: Apache-2.0
// Drives the whole service, LCM included, with a camera that delivers as soon as the last pair is
// done with, and prints every tenth of the way what a frame took and what memory there is.
#include <atomic>
#include <cstdio>
#include <string>
#include <thread>

#include "app/service/pipeline.h"
#include "bench/parse_command_line.h"
#include "platform/clocks.h"
#include "platform/process_memory.h"
#include "service/listener.h"
#include "support/synthetic_run.h"

namespace darkling {
namespace {

constexpr std::int64_t kReports = 10;

// Pairs of a scene, to and fro, one at a time.
class TirelessSource final : public FrameSource {
 public:
  TirelessSource(const test::SyntheticRun& run, std::int64_t frames) : run_(run), frames_(frames) {}

  Result<void> start() override { return {}; }
  void stop() override {}
  [[nodiscard]] SourceStats stats() const override { return {.delivered = next_}; }

  WaitResult wait_next(Duration) override {
    while (is_on_loan_) std::this_thread::yield();
    if (next_ >= frames_) return {.status = WaitStatus::kEndOfSource};
    const auto period = static_cast<std::int64_t>(2 * (run_.frames.size() - 1));
    const std::int64_t phase = next_ % period;
    StereoFrame frame =
        run_.frames[static_cast<std::size_t>(std::min(phase, period - phase))].at(next_);
    frame.stamp = frame_time_from_ns(to_ns(read_monotonic_clock()));
    ++next_;
    is_on_loan_ = true;
    WaitResult result;
    result.status = WaitStatus::kFrame;
    result.lease = FrameLease(
        frame, [](void* self, int) { static_cast<TirelessSource*>(self)->is_on_loan_ = false; },
        this, 0);
    return result;
  }

 private:
  const test::SyntheticRun& run_;
  std::int64_t frames_;
  std::atomic<std::int64_t> next_ = 0;
  std::atomic<bool> is_on_loan_ = false;
};

// What was typed.
struct Words {
  std::int64_t frames = 100'000;
  int width_px = 160;
};

int run(const Words& words) {
  const auto [frames, width] = words;
  const std::string size = std::to_string(width);
  const test::SyntheticRun& scene = test::synthetic_run("corridor,frames=20,seed=3,width=" + size);
  Config config;
  config.odometry.width_px = width;
  config.service.lcm_url = test::new_lcm_url();
  auto pipeline =
      Pipeline::create(config, {.name = "tireless",
                                .source = std::make_unique<TirelessSource>(scene, frames),
                                .rig = scene.rig});
  if (!pipeline) {
    std::fprintf(stderr, "long_run: %s\n", pipeline.error().message.c_str());
    return static_cast<int>(pipeline.error().code);
  }
  (*pipeline)->start(/*first_reset_counter=*/0);
  PipelineStatus& status = (*pipeline)->status();
  std::printf("%10s %12s %12s %12s\n", "frames", "us a frame", "resident MB", "heap calls");
  MonotonicTime before = read_monotonic_clock();
  for (std::int64_t part = 1; part <= kReports; ++part) {
    const std::int64_t goal = frames * part / kReports;
    const std::int64_t from = status.pairs_in.get();
    if (goal == from) continue;  // fewer frames than reports
    while (status.pairs_in.get() < goal && !(*pipeline)->is_over()) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    const MonotonicTime now = read_monotonic_clock();
    const double took_us = std::chrono::duration<double, std::micro>(now - before).count();
    before = now;
    std::printf("%10lld %12.1f %12.1f %12lld\n", static_cast<long long>(status.pairs_in.get()),
                took_us / static_cast<double>(status.pairs_in.get() - from),
                static_cast<double>(read_rss_bytes().value_or(0)) * 1e-6,
                static_cast<long long>(status.heap_calls.get()));
    std::fflush(stdout);
  }
  const std::int64_t passed_over = status.pairs_skipped.get() + status.pairs_refused.get();
  const std::int64_t unpublished = status.estimates_refused.get();
  std::printf("passed over %lld, estimates not published %lld\n",
              static_cast<long long>(passed_over), static_cast<long long>(unpublished));
  return passed_over == 0 ? 0 : static_cast<int>(ExitCode::kInternal);
}

constexpr const char* kAbout =
    "Drives all threads of the service, LCM included, with a rendered camera that delivers as "
    "soon\n"
    "as the last pair is done with.";

constexpr const char* kMore =
    "Prints ten times on the way how many frames there were, what one took since the line before,\n"
    "how much memory is resident, and how often the odometry called the heap: the last two stay\n"
    "as they are from the first line on. 100 000 frames 160 px wide take about a minute.\n\n"
    "Examples:\n"
    "  long_run                                  # after a change of the service\n"
    "  long_run --frames 1000000 --width 96      # the figures of docs/reliability.md\n\n"
    "Exit codes:\n"
    "  0 every frame was tracked   64 usage   70 frames were passed over\n";

int run_command_line(int argc, const char* const* argv) {
  Words words;
  CLI::App app(kAbout, "long_run");
  app.footer(kMore);
  app.add_option("--frames", words.frames, "How many pairs; default 100000")
      ->type_name("N")
      ->check(CLI::Range(std::int64_t{1}, std::int64_t{1'000'000'000'000}));
  app.add_option("--width", words.width_px, "Of the images, and to track at; default 160")
      ->type_name("PX")
      ->check(CLI::Range(64, 1280));
  const std::optional<int> status = test::parse_command_line(app, argc, argv);
  return status ? *status : run(words);
}

}  // namespace
}  // namespace darkling

int main(int argc, char** argv) {
  return darkling::run_command_line(argc, argv);
}
