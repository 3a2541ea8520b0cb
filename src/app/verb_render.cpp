// SPDX-License-Identifier: Apache-2.0
#include "app/verb_render.h"

#include <algorithm>
#include <cstdio>

#include "app/verb.h"
#include "drivers/synthetic/synthetic_source.h"
#include "platform/signals.h"
#include "platform/terminal.h"

namespace darkling {

namespace {

// Tells how far it is: one line that is rewritten on a terminal, else a line every tenth.
class RenderProgress {
 public:
  explicit RenderProgress(int frame_count)
      : frame_count_(frame_count), is_terminal_(is_stderr_terminal()) {}

  void show(int done) const {
    const int tenth = std::max(frame_count_ / 10, 1);
    if (!is_terminal_ && done % tenth != 0 && done != frame_count_) return;
    std::fprintf(stderr,
                 is_terminal_ ? "\r\033[Krendered %d of %d frames" : "rendered %d of %d frames\n",
                 done, frame_count_);
    std::fflush(stderr);
  }
  void finish() const {
    if (is_terminal_) std::fputs("\r\033[K", stderr);
  }

 private:
  int frame_count_;
  bool is_terminal_;
};

Result<void> check_layout(const RenderOptions& options) {
  const SyntheticSpec& spec = options.spec;
  const bool is_rectified = spec.distortion == 0.0 && spec.roll_right_deg == 0.0;
  if (options.layout == DatasetLayout::kEuroc || is_rectified) return {};
  return failure(ExitCode::kUsage,
                 "the KITTI layout holds rectified images only: found distortion=" +
                     std::to_string(spec.distortion) +
                     ", roll_right_deg=" + std::to_string(spec.roll_right_deg) +
                     "; set both to 0, or use --layout euroc");
}

// @return how many frames were written.
Result<int> write_frames(SyntheticSource& source, DatasetWriter& writer) {
  const RenderProgress progress(source.spec().frames);
  int done = 0;
  while (!is_stop_requested()) {
    const WaitResult next = source.wait_next(std::chrono::seconds(1));
    if (next.status == WaitStatus::kEndOfSource) break;
    if (next.status != WaitStatus::kFrame) continue;
    const StereoFrame& frame = next.lease.frame();
    const Se3 T_world_body = source.T_world_body(static_cast<int>(frame.sequence));
    if (auto written = writer.add(frame, T_world_body); !written) {
      progress.finish();
      return tl::unexpected(written.error());
    }
    progress.show(++done);
  }
  progress.finish();
  return done;
}

}  // namespace

Result<int> run_render(const RenderOptions& options) {
  SyntheticSpec spec = options.spec;
  if (auto ok = check_synthetic(spec); !ok) return tl::unexpected(ok.error());
  if (auto ok = check_layout(options); !ok) return tl::unexpected(ok.error());
  if (auto ok = prepare_folder(options.folder, options.is_forced); !ok) {
    return tl::unexpected(ok.error());
  }
  const DatasetDescription description{.folder = options.folder,
                                       .about = "Rendered: " + spec.scene,
                                       .rig = make_synthetic_rig(spec),
                                       .rate_hz = spec.rate_hz};
  const bool is_euroc = options.layout == DatasetLayout::kEuroc;
  auto writer = is_euroc ? create_euroc_writer(description) : create_kitti_writer(description);
  if (!writer) return tl::unexpected(writer.error());

  catch_stop_signals();
  auto source = SyntheticSource::create(spec);
  if (!source) return tl::unexpected(source.error());
  if (auto started = (*source)->start(); !started) return tl::unexpected(started.error());
  const auto done = write_frames(**source, **writer);
  const auto closed = (*writer)->close();
  if (!done) return tl::unexpected(done.error());
  if (!closed) return tl::unexpected(closed.error());
  std::printf("%d frames of %s, %d x %d px, %s layout: %s\n", *done, spec.scene.c_str(), spec.width,
              spec.height, is_euroc ? "EuRoC" : "KITTI", options.folder.c_str());
  if (*done > 0) std::printf("Try: darkling replay %s\n", options.folder.c_str());
  return is_stop_requested() ? kInterruptedStatus : 0;
}

}  // namespace darkling
