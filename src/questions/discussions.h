/// @file
/// The discussions of questions 4 to 7: what the numbers say, in words that follow them. Each appends its heading and its paragraphs.
#pragma once

#include <vector>

#include "questions/denoising_study.h"
#include "questions/explicit_study.h"
#include "questions/implicit_study.h"
#include "questions/spectral_study.h"
#include "report/document.h"

namespace meshfolio {

void add_spectral_discussion(report::Section& section, const std::vector<SpectralStudy>& studies);
void add_explicit_discussion(report::Section& section, const std::vector<ExplicitStudy>& studies);
void add_implicit_discussion(report::Section& section, const std::vector<ImplicitStudy>& studies);
void add_denoising_discussion(report::Section& section, const std::vector<DenoisingStudy>& studies);

}   // namespace meshfolio
