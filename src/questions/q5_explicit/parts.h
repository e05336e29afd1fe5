/// @file
/// The parts of question 5.
#pragma once

#include "questions/q5_explicit/study.h"

namespace meshfolio::q5_explicit {

inline constexpr report::Words words("q5");
extern const LabOffer lab;

using Studies = std::vector<ExplicitStudy>;

/// Returns the vertices where the top mode is largest if a few set the limit; else none.
std::vector<int> limiting_spot(const ExplicitStudy& study);

/// One wave after 0, 1 and 2 steps, explicit beside implicit, for three products λμ.
report::Diagram wave_diagram();
/// The inputs, and what the recommended steps make of them from six directions; nothing if none is recommended.
void add_recommended_figure(Answer& answer, const Studies& studies);
std::string recommended_figure(const Studies& studies);
/// Whether a step beyond the limit was tried; then one figure shows states of such runs, a row a mesh.
bool has_frames(const Studies& studies);
void add_frames_figure(Answer& answer, const Studies& studies);

/// What the answer and the paragraphs "limit", "step", "beyond", "stop" and "units" state.
report::Facts facts_of(const Studies& studies);

}   // namespace meshfolio::q5_explicit
