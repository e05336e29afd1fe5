/// @file
/// The blocks of the section "reproductions": what each kind of experiment shows. Private to the section.
#pragma once

#include "questions/reproductions/study.h"

namespace meshfolio::reproductions {

inline constexpr report::Words words("reproductions");

/// One experiment and where its blocks go.
struct Reproduction {
    Answer& answer;
    const Experiment& experiment;
    const QuestionSettings& settings;
    std::string id;   // "reproductions_03": what its tables, figures and files begin with

    report::Section& section() const { return answer.section; }
    /// "S0, row 20".
    std::string where() const;
    std::string id_of(const std::string& what) const { return id + "_" + what; }
};

// Each: heading, what the report says, what was done here, figures, table or plot, and what was found.
void add_curvature_reproduction(const Reproduction& r, const CurvatureExperiment& done);
void add_forms_reproduction(const Reproduction& r);
void add_reconstruction_reproduction(const Reproduction& r, const ReconstructionExperiment& done);
void add_smoothing_reproduction(const Reproduction& r, const SmoothingExperiment& done);
void add_noisy_reproduction(const Reproduction& r, const NoisyExperiment& done);

/// Rows 7 to 34: which experiments answer each, of the bundled files and here, and which other section does.
report::Table coverage_table(const std::vector<Experiment>& bundled, const std::vector<Experiment>& here);
/// The rows that neither an experiment nor another section answers.
std::vector<int> uncovered_rows(const std::vector<Experiment>& experiments);

// ---- what they share -------------------------------------------------------------------------------------------------

/// Heading and opening: what the report says, on which meshes this is done here, how parameters carry over, which are lost.
void add_opening(const Reproduction& r, const std::vector<ExperimentMesh>& meshes);

/// Appends a sentence and a space.
inline void tell(report::Text& text, const report::Text& sentence) { report::extend(text, sentence, " "); }
/// "row 20", "rows 7, 8 and 9".
std::string rows_text(const std::vector<int>& rows);
/// "1×10⁻⁷", "0.5 λ_crit", "0.02 h̄²": as the settings have it.
std::string given_text(const Experiment& experiment, double lambda);
/// "0.0013", "1 % of the box", …
std::string noise_text(const Experiment& experiment, double noise);
/// How a run smooths: "implicit", "explicit, uniform"; operator and areas where they are not the usual ones or there are several.
std::string variant_text(const Experiment& experiment, OperatorKind kind, AreaForm area, const SmoothingMethod& method);
/// A number as people would write it who chose it: 0.05, 1 × 10⁻⁷; at most three digits.
std::string chosen_text(double x);
/// "0.3", "0.3 to 0.9": least and largest. @param values  at least one
std::string range_text(const std::vector<double>& values);
/// Makes the first letter upper case if it is a Latin one.
std::string sentence_case(std::string words);

/// How the id of what is coloured so ends: "h_cotan".
std::string key_of(ExperimentColour colour);
/// A figure on this mesh, with the mesh itself as its first panel.
output::FigureRequest figure_on(const Reproduction& r, const ExperimentMesh& mesh, const std::string& first_panel);
/// The range of a figure, from these panels alone; nothing when there are no values.
std::optional<output::ColorRange> range_of(const Reproduction& r, ExperimentColour colour, const std::vector<output::Panel>& panels);

}   // namespace meshfolio::reproductions
