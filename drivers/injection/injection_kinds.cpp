// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "base/number_text.h"
#include "drivers/injection/injection.h"
#include "drivers/injection/light.h"
#include "drivers/injection/stateless.h"
#include "drivers/injection/transport.h"
#include "drivers/injection/view.h"
#include "drivers/sensor/mix64.h"

namespace darkling {

namespace {

using enum ValueForm;

constexpr InjectionKind kKinds[] = {
    {"electrons", kNumber, "N", 0.1, 100000, "light for N photo-electrons a pixel on average",
     make_electrons},
    {"gain", kNumber, "F", 0.01, 100, "brighter by the factor F", make_stateless<apply_gain>},
    {"gamma", kNumber, "G", 0.1, 10, "levels as their power G", make_stateless<apply_gamma>},
    {"saturate", kNumber, "SHARE", 0.001, 0.99, "so bright that SHARE of the pixels clip",
     make_stateless<apply_saturate>},
    {"flicker", kNumber, "SHARE", 0.01, 1, "brighter or darker by SHARE, anew every frame",
     make_stateless<apply_flicker>},
    {"lamp", kNumber, "F", 0.1, 100, "a spot that wanders, brighter by 1 + F", make_lamp},
    {"vignette", kNumber, "SHARE", 0.01, 1, "corners darker by SHARE", make_vignette},
    {"blackout", kNone, "", 0, 0, "no light at all: black and a little noise",
     make_stateless<apply_blackout>},
    {"blur_px", kWholeNumber, "N", 2, 64, "smeared over N px, in a direction that turns slowly",
     make_blur},
    {"roll_right_deg", kNumber, "D", -10, 10, "the right camera turned by D about its axis",
     make_roll_right},
    {"occlude", kNumber, "SHARE", 0.01, 0.9, "a near board that wanders before SHARE of the image",
     make_occlude},
    {"drop", kNumber, "P", 0, 1, "pairs lost with probability P", make_stateless<apply_drop>},
    {"drop_every", kWholeNumber, "N", 2, 10000, "every N-th pair lost",
     make_stateless<apply_drop_every>},
    {"freeze", kNone, "", 0, 0, "the pair before FIRST again and again, with new stamps",
     make_freeze},
    {"skew_ms", kNumber, "T", 0.1, 500, "the right image older by T", make_skew},
    {"tear", kWord, "left|right|both", 0, 0, "the lower half is still that of the frame before",
     make_tear},
    {"corrupt", kNumber, "P", 0, 1, "blocks of garbage in one eye with probability P",
     make_stateless<apply_corrupt>},
    {"swap", kNone, "", 0, 0, "left and right exchanged", make_stateless<apply_swap>},
    {"same_eyes", kNone, "", 0, 0, "the right image is the left one",
     make_stateless<apply_same_eyes>},
    {"cover", kWord, "left|right", 0, 0, "one eye covered, as by blackout",
     make_stateless<apply_cover>},
    {"black", kNone, "", 0, 0, "both images at level 0", make_stateless<apply_black>},
    {"white", kNone, "", 0, 0, "both images at level 255", make_stateless<apply_white>},
    {"constant", kWholeNumber, "LEVEL", 0, 255, "both images at one level",
     make_stateless<apply_constant>},
    {"noise", kNone, "", 0, 0, "both images of random levels", make_stateless<apply_noise>},
};

// FNV-1a.
std::uint64_t hash_of(std::string_view name) {
  std::uint64_t hash = 0xcbf29ce484222325ull;
  for (const char c : name) hash = (hash ^ static_cast<std::uint8_t>(c)) * 0x100000001b3ull;
  return hash;
}

std::string spelt(const InjectionKind& kind) {
  const std::string name(kind.name);
  return kind.form == kNone ? name : name + "=" + std::string(kind.value_name);
}

}  // namespace

std::span<const InjectionKind> injection_kinds() {
  return kKinds;
}

std::string describe_injections() {
  constexpr std::size_t kColumn = 24;
  std::string text;
  for (const InjectionKind& kind : kKinds) {
    std::string line = "  " + spelt(kind);
    line.resize(std::max(kColumn, line.size() + 2), ' ');
    line += kind.meaning;
    if (kind.form == kNumber || kind.form == kWholeNumber) {
      line += "; " + number_text(kind.lowest) + " to " + number_text(kind.highest);
    }
    text += line + "\n";
  }
  return text;
}

std::uint64_t noise_key(const Injection& injection, std::int64_t sequence, int stream) {
  const std::uint64_t seeded = mix64(injection.seed + hash_of(injection.kind->name));
  return mix64(mix64(seeded + static_cast<std::uint64_t>(sequence)) +
               static_cast<std::uint64_t>(stream));
}

}  // namespace darkling
