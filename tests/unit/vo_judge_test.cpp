// SPDX-License-Identifier: Apache-2.0
#include <functional>

#include <gtest/gtest.h>

#include "vo/judge.h"

namespace darkling {
namespace {

constexpr double kFocalPx = 200.0;

// Template points 4 m away: f / z = 50 px/m.
TemplateLevel finest_level() {
  TemplateLevel level;
  level.points.count = 800;
  level.mean_inverse_depth_focal = 50.0f;
  return level;
}

// As good as an alignment gets.
Alignment good_alignment() {
  Alignment alignment;
  alignment.score = {.distance = 0.1, .cost = 0.1, .visible_fraction = 0.95, .visible_count = 760};
  alignment.has_converged = true;
  alignment.information = Matrix6::Identity();
  alignment.information.topLeftCorner<3, 3>() *= 50.0 * 50.0;
  alignment.information.bottomRightCorner<3, 3>() *= kFocalPx * kFocalPx;
  return alignment;
}

Judgement judge(const Alignment& alignment) {
  return judge_alignment(alignment, finest_level(), kFocalPx);
}

TEST(JudgeAlignment, IsValidWithoutReasonsWhenAllIsWell) {
  const Judgement judgement = judge(good_alignment());
  EXPECT_EQ(judgement.status, TrackStatus::kValid);
  EXPECT_EQ(judgement.reasons, kReasonNone);
  EXPECT_FALSE(judgement.is_keyframe_due);
  EXPECT_GT(judgement.quality, 70);
  EXPECT_LE(judgement.quality, 100);
}

struct JudgeCase {
  const char* name;
  std::function<void(Alignment&)> spoil;
  TrackStatus status;
  std::uint32_t reasons;
};

class EachFault : public ::testing::TestWithParam<JudgeCase> {};

TEST_P(EachFault, HasItsStatusAndReason) {
  Alignment alignment = good_alignment();
  GetParam().spoil(alignment);
  const Judgement judgement = judge(alignment);
  EXPECT_EQ(judgement.status, GetParam().status);
  EXPECT_EQ(judgement.reasons, GetParam().reasons);
  const bool is_lost = GetParam().status == TrackStatus::kLost;
  EXPECT_EQ(judgement.quality == -1, is_lost) << judgement.quality;
  // A bad frame never becomes a keyframe.
  EXPECT_TRUE(!is_lost || !judgement.is_keyframe_due);
}

const JudgeCase kFaults[] = {
    {"FewPoints", [](Alignment& a) { a.score.visible_count = 10; }, TrackStatus::kLost,
     kReasonLowTexture},
    {"HardlyAnyOverlap", [](Alignment& a) { a.score.visible_fraction = 0.05; }, TrackStatus::kLost,
     kReasonLowOverlap},
    {"LittleOverlap", [](Alignment& a) { a.score.visible_fraction = 0.2; }, TrackStatus::kDegraded,
     kReasonLowOverlap},
    {"UnrelatedImages", [](Alignment& a) { a.score.cost = 0.9; }, TrackStatus::kLost,
     kReasonResidualHigh},
    {"PoorMatch", [](Alignment& a) { a.score.cost = 0.65; }, TrackStatus::kDegraded,
     kReasonResidualHigh},
    {"IterationBound", [](Alignment& a) { a.has_converged = false; }, TrackStatus::kDegraded,
     kReasonNotConverged},
    {"UnseenDirection",
     [](Alignment& a) {
       a.information.row(2).setZero();
       a.information.col(2).setZero();
     },
     TrackStatus::kDegraded, kReasonIllConditioned},
    {"NothingSeen", [](Alignment& a) { a = Alignment(); }, TrackStatus::kLost,
     kReasonLowTexture | kReasonLowOverlap | kReasonResidualHigh | kReasonNotConverged |
         kReasonIllConditioned},
};

INSTANTIATE_TEST_SUITE_P(Judge, EachFault, ::testing::ValuesIn(kFaults),
                         [](const auto& tested) { return tested.param.name; });

TEST(JudgeAlignment, IsNotDeceivedByTheUnitOfLength) {
  Alignment alignment = good_alignment();
  TemplateLevel level = finest_level();
  // The same scene a thousand times as far away, the same pixels.
  level.mean_inverse_depth_focal = 0.05f;
  alignment.information.topLeftCorner<3, 3>() *= 1e-6;
  EXPECT_EQ(judge_alignment(alignment, level, kFocalPx).reasons, kReasonNone);
}

TEST(JudgeAlignment, WantsAKeyframeWhenTheViewHasChanged) {
  const auto is_due = [](const std::function<void(Alignment&)>& change) {
    Alignment alignment = good_alignment();
    change(alignment);
    const Judgement judgement = judge(alignment);
    EXPECT_EQ(judgement.status, TrackStatus::kValid);
    return judgement.is_keyframe_due;
  };
  const auto shift = [](double metres) {
    return [metres](Alignment& a) {
      a.T_current_key = Se3(Eigen::Quaterniond::Identity(), Vector3(metres, 0.0, 0.0));
    };
  };
  EXPECT_TRUE(is_due([](Alignment& a) { a.score.visible_fraction = 0.6; }));
  EXPECT_TRUE(is_due([](Alignment& a) { a.score.distance = 0.5; }));
  EXPECT_FALSE(is_due([](Alignment& a) { a.score.cost = 0.5; })) << "as all are in the dark";
  EXPECT_TRUE(is_due(shift(0.25 * 4.0)));  // a quarter of the depth
  EXPECT_FALSE(is_due(shift(0.05 * 4.0)));
  // Never by metres alone: the same metre among far things is little.
  Alignment far = good_alignment();
  shift(1.0)(far);
  TemplateLevel level = finest_level();
  level.mean_inverse_depth_focal = 2.0f;  // 100 m
  far.information.topLeftCorner<3, 3>() *= 4.0 / 2500.0;
  EXPECT_FALSE(judge_alignment(far, level, kFocalPx).is_keyframe_due);
}

TEST(JudgeAlignment, LowersTheQualityWithCostAndOverlap) {
  int previous = 101;
  for (const double cost : {0.05, 0.2, 0.35, 0.5, 0.65}) {
    Alignment alignment = good_alignment();
    alignment.score.cost = cost;
    const int quality = judge(alignment).quality;
    EXPECT_LT(quality, previous) << cost;
    EXPECT_GE(quality, 1);
    previous = quality;
  }
  Alignment narrow = good_alignment();
  narrow.score.visible_fraction = 0.2;
  EXPECT_LT(judge(narrow).quality, judge(good_alignment()).quality);
}

TEST(AlignmentScore, RanksAPointOutsideTheImageAsHalfAMismatch) {
  const AlignmentScore all_seen = {.distance = 0.4, .visible_fraction = 1.0, .visible_count = 100};
  const AlignmentScore half_seen = {.distance = 0.3, .visible_fraction = 0.5, .visible_count = 50};
  const AlignmentScore unseen;
  EXPECT_DOUBLE_EQ(all_seen.rank(), 0.4);
  EXPECT_DOUBLE_EQ(half_seen.rank(), 0.4);
  EXPECT_DOUBLE_EQ(unseen.rank(), 0.5);
}

}  // namespace
}  // namespace darkling
