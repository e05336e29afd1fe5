/// @file
/// The blocks of the section "methods". Private to the layer.
#pragma once

#include <numbers>
#include <vector>

#include "questions/core/chapter.h"
#include "questions/methods/study.h"

namespace meshfolio::methods {

/// Tables tell angles in degrees.
inline constexpr double degrees = 180 / std::numbers::pi;

report::Table subject_table(const DenoisingLaboratory& laboratory);
/// What a method is judged by: the shape, the places of the vertices, the normals of the faces.
enum class Measure { shape, places, normals };
/// Gains of every method, one row a noisy mesh.
report::Table gain_table(const DenoisingTrials& mesh, Measure measure);
/// Every method at its best on every noisy mesh, in all measures.
report::Table result_table(const DenoisingTrials& mesh);
report::Table winner_table(const std::vector<ClassResult>& classes);
report::Table limit_table(const DenoisingLaboratory& laboratory);
report::Plot gain_plot(const DenoisingTrials& mesh);
/// Clean, noisy and every method at its best, one small picture each.
void add_method_figure(Answer& answer, const DenoisingTrials& mesh, const NoiseTrial& trial);
std::vector<report::Check> method_checks(const DenoisingLaboratory& laboratory);

/// What the numbers say. Appends its heading and its paragraphs.
void add_discussion(report::Section& section, const DenoisingLaboratory& laboratory);

/// "explicit": the title of a method by its place in denoising_list().
std::string method_title(int method);

}   // namespace meshfolio::methods
