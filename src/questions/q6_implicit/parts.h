/// @file
/// The parts of question 6.
#pragma once

#include <vector>

#include "questions/q6_implicit/study.h"
#include "report/document.h"

namespace meshfolio::q6_implicit {

/// What the numbers say, in words that follow them. Appends its heading and its paragraphs.
void add_discussion(report::Section& section, const std::vector<ImplicitStudy>& studies);

}   // namespace meshfolio::q6_implicit
