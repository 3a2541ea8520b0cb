// SPDX-License-Identifier: Apache-2.0
// Measures the service as its receivers see it: starts it with a rendered scene at 20 Hz, listens,
// and prints how late poses are received, what the process takes, and what was lost.
#include <algorithm>
#include <array>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>
#include <vector>

#include <lcm/lcm-cpp.hpp>
#include <sys/wait.h>
#include <unistd.h>

#include "bench/parse_command_line.h"
#include "messages/pose_t.hpp"
#include "messages/status_t.hpp"
#include "platform/clocks.h"
#include "service/listener.h"
#include "service/notify_socket.h"

namespace darkling {
namespace {

double ms_between(MonotonicTime from, MonotonicTime to) {
  return std::chrono::duration<double, std::milli>(to - from).count();
}

// What LCM calls back, at once: a test's listener looks only now and then.
struct Receiver {
  std::vector<double> late_ms;
  std::vector<std::int64_t> sequences;
  MonotonicTime first_at;
  status_t status = {};

  void on_pose(const lcm::ReceiveBuffer*, const std::string&, const pose_t* pose) {
    const MonotonicTime now = read_monotonic_clock();
    if (late_ms.empty()) first_at = now;
    late_ms.push_back(static_cast<double>(to_ns(now) - pose->mono_ns) * 1e-6);
    sequences.push_back(pose->seq);
  }
  void on_status(const lcm::ReceiveBuffer*, const std::string&, const status_t* heard) {
    status = *heard;
  }
};

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return -1.0;
  std::sort(values.begin(), values.end());
  const auto last = static_cast<double>(values.size() - 1);
  return values[static_cast<std::size_t>(share * last + 0.5)];
}

// Of the process and all its threads so far, s.
double cpu_time_s(pid_t pid) {
  std::ifstream file("/proc/" + std::to_string(pid) + "/stat");
  std::string text;
  std::getline(file, text);
  const std::string fields = text.substr(text.rfind(')') + 2);
  long long user = 0;
  long long system = 0;
  std::sscanf(fields.c_str(), "%*c %*d %*d %*d %*d %*d %*u %*u %*u %*u %*u %lld %lld", &user,
              &system);
  return static_cast<double>(user + system) / static_cast<double>(sysconf(_SC_CLK_TCK));
}

pid_t start_service(const std::vector<std::string>& words) {
  const pid_t pid = fork();
  if (pid != 0) return pid;
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  execv(arguments[0], arguments.data());
  std::perror(arguments[0]);
  _exit(127);
}

int measure(double seconds, const std::vector<std::string>& settings) {
  const std::string url = test::new_lcm_url();
  test::NotifySocket notifications;
  setenv("NOTIFY_SOCKET", notifications.path().c_str(), 1);
  lcm::LCM lcm(url);
  if (!lcm.good()) return 69;
  Receiver receiver;
  lcm.subscribe("VO_POSE", &Receiver::on_pose, &receiver)->setQueueCapacity(1000);
  lcm.subscribe("VO_STATUS", &Receiver::on_status, &receiver);

  std::vector<std::string> words = {DARKLINGD_PROGRAM, "--set", "lcm_url=" + url};
  for (const std::string& setting : settings) words.insert(words.end(), {"--set", setting});
  const MonotonicTime started_at = read_monotonic_clock();
  const pid_t pid = start_service(words);
  if (!notifications.wait_for("READY=1", std::chrono::seconds(60))) {
    kill(pid, SIGKILL);
    return 70;
  }
  const double ready_ms = ms_between(started_at, read_monotonic_clock());
  while (receiver.late_ms.empty()) lcm.handleTimeout(100);
  const double cpu_before_s = cpu_time_s(pid);
  const MonotonicTime from = receiver.first_at;
  while (ms_between(from, read_monotonic_clock()) < seconds * 1e3) lcm.handleTimeout(100);
  const double cpu_s = cpu_time_s(pid) - cpu_before_s;
  kill(pid, SIGTERM);
  waitpid(pid, nullptr, 0);

  const std::vector<double>& late = receiver.late_ms;
  const std::int64_t span = receiver.sequences.back() - receiver.sequences.front() + 1;
  std::printf("frames            %zu in %.0f s, %lld not received, %lld passed over\n", late.size(),
              seconds, static_cast<long long>(span - std::ssize(late)),
              static_cast<long long>(receiver.status.frames_skipped));
  std::printf("stamp to received %.2f ms p50, %.2f p99, %.2f p99.9, %.2f max\n",
              quantile(late, 0.5), quantile(late, 0.99), quantile(late, 0.999),
              quantile(late, 1.0));
  std::printf("processor         %.1f %% of a core\n", 100.0 * cpu_s / seconds);
  std::printf("resident          %.1f MB, %lld heap calls of the odometry\n",
              static_cast<double>(receiver.status.rss_bytes) * 1e-6,
              static_cast<long long>(receiver.status.heap_calls));
  std::printf("exec to           READY %.0f ms, first pose %.0f ms\n", ready_ms,
              ms_between(started_at, receiver.first_at));
  return 0;
}

constexpr const char* kAbout =
    "Starts darklingd with a rendered camera at 20 Hz, listens as a receiver would, and prints "
    "how\n"
    "late poses are received, what the process takes, and what was lost.";

constexpr const char* kMore =
    "Examples:\n"
    "  measure_service --for 600\n"
    "  measure_service --set camera=drive.lcmlog --set width_px=160\n\n"
    "Exit codes:\n"
    "  0 measured   64 usage   69 no route for LCM   70 the service did not get ready in 60 s\n";

int run_command_line(int argc, const char* const* argv) {
  constexpr double kMost_s = 1e6;
  double seconds = 30.0;
  std::vector<std::string> settings;
  CLI::App app(kAbout, "measure_service");
  app.footer(kMore);
  app.add_option("--for", seconds, "How long to listen from the first pose on; default 30")
      ->type_name("SECONDS")
      ->check(CLI::Range(1.0, kMost_s))
      ->check([](const std::string& text) {  // a range holds what is no number, too
        return std::isfinite(std::strtod(text.c_str(), nullptr)) ? "" : "is no number";
      });
  app.add_option("--set", settings, "A setting of darklingd; default a corridor 320 px wide")
      ->type_name("KEY=VALUE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  const std::optional<int> status = test::parse_command_line(app, argc, argv);
  if (status) return *status;
  if (settings.empty()) settings = {"camera=synthetic:corridor,frames=40,width=320"};
  return measure(seconds, settings);
}

}  // namespace
}  // namespace darkling

int main(int argc, char** argv) {
  return darkling::run_command_line(argc, argv);
}
