// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>

#include "app/open_source.h"
#include "drivers/frame_source.h"

namespace darkling {

// The frames of another source that the options select; the others are passed over unseen.
class SelectedFrames final : public FrameSource {
 public:
  // @pre `source` numbers its frames from 0 without gaps.
  SelectedFrames(std::unique_ptr<FrameSource> source, const OpenOptions& options);

  Result<void> start() override;
  WaitResult wait_next(Duration timeout) override;
  void stop() override { source_->stop(); }
  [[nodiscard]] SourceStats stats() const override { return stats_; }

 private:
  void count(const WaitResult& result);

  std::unique_ptr<FrameSource> source_;
  OpenOptions options_;
  SourceStats stats_;
};

}  // namespace darkling
