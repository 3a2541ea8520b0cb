// SPDX-License-Identifier: Apache-2.0
// What people write or other programs leave behind, as anything at all: files of configuration,
// calibrations and trajectories, and words of the command line. Entered by the fuzzers of
// tests/fuzz, and by unit tests with random damage. Each throws what breaks a promise: a refusal
// that gives no reason or another exit code than it should, or something accepted that cannot be.
#pragma once

#include <cstddef>
#include <span>

namespace darkling::test {

// A configuration file. One that is accepted is written and read back as itself.
// @return whether it is accepted.
bool load_any_config(std::span<const std::byte> bytes);

// A calibration: the first byte chooses how its files lie, `bytes` up to a zero are the first of
// them, what follows is the second where there are two.
// @return whether it is accepted.
bool load_any_calibration(std::span<const std::byte> bytes);

// A trajectory, which is then compared with itself.
// @return how many poses there were.
std::size_t read_any_trajectory(std::span<const std::byte> bytes);

// A word of the command line, as each of those that are parsed: sources, injections, settings,
// numbers, times.
// @return as how many of them it is accepted.
int understand_any_word(std::span<const std::byte> bytes);

}  // namespace darkling::test
