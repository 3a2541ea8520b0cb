// SPDX-License-Identifier: Apache-2.0
// Stands in for libFuzzer where the compiler has none: tries the files it is given, then damages
// them at random for as long as it is told to, and takes the same options. It learns nothing on the
// way.
#include <charconv>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "support/damage.h"
#include "support/temporary_folder.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size);  // NOLINT
// Of the sanitizers, where there is one: calls back before the process ends.
extern "C" [[gnu::weak]] void __sanitizer_set_death_callback(void (*callback)());  // NOLINT

namespace {

using Bytes = std::vector<std::byte>;

struct Words {
  std::int64_t most_s = 60;
  std::int64_t most_bytes = 8192;
  std::string artifact_prefix = "broken_";
  std::vector<std::string> paths;
};

// Of the input that is being tried, so that what breaks the process is not lost.
Bytes tried;
std::string artifact_path;

void keep_input() {
  std::FILE* file = std::fopen(artifact_path.c_str(), "wb");
  if (file == nullptr) return;
  std::fwrite(tried.data(), 1, tried.size(), file);
  std::fclose(file);
  std::fprintf(stderr, "the input is in %s\n", artifact_path.c_str());
}

bool read_option(std::string_view word, std::string_view name, std::int64_t& value) {
  if (!word.starts_with(name)) return false;
  word.remove_prefix(name.size());
  return std::from_chars(word.data(), word.data() + word.size(), value).ec == std::errc();
}

Words understand(int argc, char** argv) {
  constexpr std::string_view kPrefix = "-artifact_prefix=";
  Words words;
  for (const std::string_view word : std::vector<std::string_view>(argv + 1, argv + argc)) {
    if (word.starts_with(kPrefix)) words.artifact_prefix = word.substr(kPrefix.size());
    if (!word.starts_with('-')) words.paths.emplace_back(word);
    read_option(word, "-max_total_time=", words.most_s);
    read_option(word, "-max_len=", words.most_bytes);
  }
  return words;
}

std::vector<Bytes> read_seeds(const std::vector<std::string>& paths) {
  namespace fs = std::filesystem;
  std::vector<Bytes> seeds;
  const auto add = [&](const fs::path& path) {
    const std::string text = darkling::test::read_text(path.string());
    const auto bytes = std::as_bytes(std::span(text));
    if (!bytes.empty()) seeds.emplace_back(bytes.begin(), bytes.end());
  };
  for (const std::string& path : paths) {
    if (!fs::is_directory(path)) {
      add(path);
      continue;
    }
    for (const auto& entry : fs::directory_iterator(path)) add(entry.path());
  }
  return seeds;
}

Bytes damaged(Bytes bytes, std::mt19937& random) {
  for (unsigned i = 0; i <= random() % 6 && !bytes.empty(); ++i) {
    darkling::test::damage(bytes, random);
  }
  return bytes;
}

// @return what broke a promise, or nothing.
std::optional<std::string> try_input() {
  try {
    LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(tried.data()), tried.size());
  } catch (const std::exception& broken) {
    return broken.what();
  }
  return std::nullopt;
}

}  // namespace

int main(int argc, char** argv) {
  using Clock = std::chrono::steady_clock;
  const Words words = understand(argc, argv);
  artifact_path = words.artifact_prefix + "input";
  if (__sanitizer_set_death_callback != nullptr) __sanitizer_set_death_callback(keep_input);
  const std::vector<Bytes> seeds = read_seeds(words.paths);
  if (seeds.empty()) {
    std::fputs("no seeds: name files, or folders that hold some\n", stderr);
    return 64;
  }
  std::mt19937 random(1);
  std::size_t runs = 0;
  const auto end = Clock::now() + std::chrono::seconds(words.most_s);
  while (runs < seeds.size() || Clock::now() < end) {
    tried = runs < seeds.size() ? seeds[runs] : damaged(seeds[random() % seeds.size()], random);
    if (std::ssize(tried) > words.most_bytes) {
      tried.resize(static_cast<std::size_t>(words.most_bytes));
    }
    ++runs;
    const std::optional<std::string> broken = try_input();
    if (!broken) continue;
    std::fprintf(stderr, "run %zu: %s\n", runs, broken->c_str());
    keep_input();
    return 77;
  }
  std::fprintf(stderr, "Done %zu runs, without libFuzzer: at random\n", runs);
  return 0;
}
