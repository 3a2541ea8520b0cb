// SPDX-License-Identifier: Apache-2.0
// What must survive any bytes at all: entered by the fuzzers of tests/fuzz, and by unit tests with
// random damage, so that every build runs it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace darkling::test {

// Decodes `bytes` as every type of message.
// @return as how many of them they make sense.
int decode_anything(std::span<const std::byte> bytes);

// Decodes `bytes` as an image of 32x16 pixels, with a decoder that has seen all those before.
// @pre can_decode_jpeg().
// @return whether it is one.
bool decode_any_jpeg(std::span<const std::byte> bytes);

// Opens a file of `bytes` as a frame log and plays it to its end, reading every pixel. Throws what
// breaks the promises of a source: rows whose number does not grow, frames of another size than the
// rig's.
// @return how many frames there were.
std::int64_t play_anything(std::span<const std::byte> bytes);

}  // namespace darkling::test
