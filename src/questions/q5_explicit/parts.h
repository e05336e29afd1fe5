/// @file
/// The parts of question 5.
#pragma once

#include "questions/q5_explicit/study.h"

namespace meshfolio::q5_explicit {

inline constexpr report::Words words("q5");

using Studies = std::vector<ExplicitStudy>;

/// The one in which the growth just beyond the limit shows most: its frames and energies are in the report, the others' in the appendix.
const ExplicitStudy& telling(const Studies& studies);

/// Returns the vertices where the top mode is largest if a few set the limit; else none.
std::vector<int> limiting_spot(const ExplicitStudy& study);
/// The inputs, and what the recommended steps make of them from six directions; nothing where none is recommended.
void add_recommended_figure(Answer& answer, const Studies& studies);
std::string recommended_figure(const Studies& studies);
/// Frames of a stable step, of one just beyond the limit, and of one far beyond, in the colours of that figure.
void add_frames_figure(Answer& answer, const ExplicitStudy& study, const Studies& studies);

/// A good step, and what a larger one does, in one sentence.
report::Text answer_in_short(const Studies& studies);
/// What follows it.
report::Text lead(const Studies& studies);
// The paragraphs of the discussion.
report::Text how_large(const Studies& studies);
report::Text which_step(const Studies& studies);
report::Text when_to_stop(const Studies& studies);
report::Text too_large(const Studies& studies);
/// What a number for λ means.
report::Text units_of_lambda(const Studies& studies);

}   // namespace meshfolio::q5_explicit
