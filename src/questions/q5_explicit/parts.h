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

/// Draws a wave after 0, 1 and 2 steps, explicit beside implicit, for three products λμ.
report::Diagram wave_diagram();
/// Adds a figure of the inputs and the results of the recommended steps; none if no step is recommended.
void add_recommended_figure(Answer& answer, const Studies& studies);
/// Returns the id of that figure.
std::string recommended_figure(const Studies& studies);
/// True if a step beyond the limit was tried.
bool has_frames(const Studies& studies);
/// Adds a figure of states of the runs beyond the limit, one row a mesh, if has_frames().
void add_frames_figure(Answer& answer, const Studies& studies);

/// Returns the facts of the answer and of the paragraphs "limit", "step", "beyond", "stop" and "units".
report::Facts facts_of(const Studies& studies);

}   // namespace meshfolio::q5_explicit
