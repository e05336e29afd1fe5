/// @file
/// The discussions of the questions: what the numbers say, in words that follow them. Each appends its heading and its paragraphs.
#pragma once

#include <vector>

#include "questions/cotangent_study.h"
#include "questions/denoising_study.h"
#include "questions/explicit_study.h"
#include "questions/ground_truth.h"
#include "questions/implicit_study.h"
#include "questions/spectral_uses.h"
#include "questions/uniform_curvature_study.h"
#include "report/document.h"

namespace meshfolio {

void add_uniform_curvature_discussion(report::Section& section, const std::vector<MeshCurvature>& meshes,
                                      const std::vector<UniformRefinement>& refinements, const std::vector<AngleSum>& sums,
                                      const std::vector<FlatMesh>& flat, const GroundTruth& truth);
void add_cotangent_curvature_discussion(report::Section& section, const std::vector<CotangentComparison>& meshes,
                                        const std::vector<CotangentRefinement>& refinements, const PlaneTest& plane,
                                        const GroundTruth& truth);
/// @param uses  one for each study
void add_spectral_discussion(report::Section& section, const std::vector<SpectralStudy>& studies, const std::vector<SpectralUses>& uses);
void add_explicit_discussion(report::Section& section, const std::vector<ExplicitStudy>& studies);
void add_implicit_discussion(report::Section& section, const std::vector<ImplicitStudy>& studies);
void add_denoising_discussion(report::Section& section, const std::vector<DenoisingStudy>& studies);

}   // namespace meshfolio
