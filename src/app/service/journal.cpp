// SPDX-License-Identifier: Apache-2.0
#include "app/service/journal.h"

#include <cstdlib>
#include <memory>

#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

namespace darkling {

namespace {

// Priorities as systemd reads them at the start of a line; a person wants the time instead.
class PriorityFlag final : public spdlog::custom_flag_formatter {
 public:
  void format(const spdlog::details::log_msg& message, const std::tm&,
              spdlog::memory_buf_t& text) override {
    const char* priority = message.level >= spdlog::level::err    ? "<3>"
                           : message.level >= spdlog::level::warn ? "<4>"
                                                                  : "<6>";
    text.append(priority, priority + 3);
  }
  [[nodiscard]] std::unique_ptr<custom_flag_formatter> clone() const override {
    return std::make_unique<PriorityFlag>();
  }
};

spdlog::logger& journal() {
  static const std::shared_ptr<spdlog::logger> kLogger = [] {
    auto made = std::make_shared<spdlog::logger>("darklingd",
                                                 std::make_shared<spdlog::sinks::stderr_sink_mt>());
    auto formatter = std::make_unique<spdlog::pattern_formatter>();
    if (std::getenv("JOURNAL_STREAM") != nullptr) {
      formatter->add_flag<PriorityFlag>('*').set_pattern("%*%v");
    } else {
      formatter->set_pattern("%H:%M:%S.%e %l: %v");
    }
    made->set_formatter(std::move(formatter));
    made->flush_on(spdlog::level::info);
    return made;
  }();
  return *kLogger;
}

}  // namespace

void report_info(const std::string& line) {
  journal().info("{}", line);
}

void report_warning(const std::string& line) {
  journal().warn("{}", line);
}

void report_error(const std::string& line) {
  journal().error("{}", line);
}

void report_wish(const std::string& key, const std::string& refusal) {
  if (refusal.empty()) return report_info(key + " granted");
  report_warning(key + ": " + refusal);
}

}  // namespace darkling
