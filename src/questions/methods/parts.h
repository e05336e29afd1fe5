/// @file
/// The parts of the denoising laboratory.
#pragma once

#include "questions/methods/study.h"

namespace meshfolio::methods {

inline constexpr report::Words words("methods");

/// Tables tell angles in degrees.
inline constexpr double degrees = 180 / pi;

/// "explicit": the title of a method by its place in denoising_list(), of that of a result.
inline std::string method_title(std::size_t method) { return std::string(denoising_list()[method].title); }
inline std::string method_title(const SearchResult& result) { return std::string(denoising_entry(result.method).title); }

report::Table subject_table(const DenoisingLaboratory& laboratory);
/// Gains of every method by one measure, one row a noisy mesh.
report::Table gain_table(const DenoisingTrials& mesh, const Measure& measure);
/// Every method at its best on the noisy mesh of the picture, in all measures.
report::Table result_table(const DenoisingTrials& mesh);
report::Table winner_table(const std::vector<ClassResult>& classes);
report::Table limit_table(const DenoisingLaboratory& laboratory);
report::Plot gain_plot(const DenoisingTrials& mesh);
/// Clean, noisy and every method at its best, one small picture each.
void add_method_figure(Answer& answer, const DenoisingTrials& mesh, const NoiseTrial& trial);

void add_discussion(report::Section& section, const DenoisingLaboratory& laboratory);

}   // namespace meshfolio::methods
