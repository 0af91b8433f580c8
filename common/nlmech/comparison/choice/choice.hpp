/// @file
/// Which method for a problem: those that were fast on problems like it run against each other on it.
#pragma once

#include <vector>

#include "nlmech/comparison/choice/chosen.hpp"
#include "nlmech/comparison/choice/expectation.hpp"
#include "nlmech/comparison/choice/question.hpp"

namespace nlmech::comparison {

/// Ranks methods. What decides are counts of steps and right-hand sides, each with what it cost where times
/// were measured, and no time of this run: asked twice, it answers the same. (Unless right-hand sides are so
/// expensive that wall time ends the runs.)
/// @returns the fastest first; empty if every method failed on the way, with the status of the first
[[nodiscard]] std::vector<Ranked> rank_methods(const Question& question, const Features& features,
                                               const Evidence& evidence, Status& status);

/// Looks at the problem and finds its condition.
/// @returns all of Chosen but the ranks; its status is a failure if the solution ends on the way
[[nodiscard]] Chosen looked_at(const Question& question, const Evidence& evidence);

/// Ranks for @p digits at the end. Question::level does not count.
/// @param looked of looked_at(), at the same question
[[nodiscard]] Chosen choose(Question question, double digits, const Evidence& evidence, Chosen looked);

/// Seconds of the unit of Measured on this machine: one right-hand side of the free Duffing oscillator.
[[nodiscard]] double unit_seconds();

}  // namespace nlmech::comparison
