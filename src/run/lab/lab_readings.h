/// @file
/// What the program itself computes on the mesh of a laboratory, to stand beside what the page does.
#pragma once

#include <array>

#include "geometry/spectrum/laplace_spectrum.h"
#include "run/lab/lab_mesh.h"

namespace meshfolio::run {

/// At these settings; none where a run has blown up.
std::vector<LabReading> readings_at(const LabMesh& lab, const Spectrum& spectrum, const std::vector<LabSetting>& settings);

/// Question 7 on this mesh, at each of its levels of noise.
std::vector<BestDenoising> denoising_on(const LabMesh& lab, const QuestionSettings& settings);

}   // namespace meshfolio::run
