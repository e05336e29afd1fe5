/// @file
/// The tools with which chapters fill their sections, and the headers that nearly all of them need.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/errors.h"
#include "base/number_text.h"
#include "geometry/linear/special_values.h"
#include "mesh/triangle_measures.h"
#include "questions/core/chapter.h"
#include "questions/core/table.h"
#include "report/text.h"
#include "report/words.h"

namespace meshfolio {

using namespace report::literals;
using report::check_at_least, report::check_at_most, report::check_near, report::undecided;

using Names = std::vector<std::string>;

// ---- the section ----------------------------------------------------------------------------------------------------------

/// Returns an empty section of the chapter `id`, with its title, question and cited code.
report::Section section_of(std::string_view id);

/// Adds the warning that the section is computed with small settings, so that the report ends in time.
void say_small_settings(report::Section& section);
/// Returns the sentence that a section is left out, so that the report ends in time.
std::string left_out_to_fit();

/// Appends a block. A plot, map or figure without an alternative text gets its caption.
void add_one(report::Section& section, report::Block block);
inline void add_one(report::Section& section, report::Check check) { section.checks.push_back(std::move(check)); }
/// Appends tables, plots, … and checks, in this order.
void add(report::Section& section, auto&&... parts) { (add_one(section, std::forward<decltype(parts)>(parts)), ...); }
void append_checks(report::Section& section, const std::vector<report::Check>& checks);
/// Puts all blocks that are added from here on into the appendix of the report.
inline void begin_appendix(report::Section& section) { section.appendix_from = static_cast<int>(section.blocks.size()); }
/// Appends the blocks of the message `key`, with the facts filled in: heading, paragraphs, formulas.
void add_words(report::Section& section, const report::Words& words, std::string_view key, const report::Facts& facts);
void add_words(report::Section& section, const report::Words& words, std::string_view key, auto... facts) {
    add_words(section, words, key, report::Facts{std::move(facts)...});
}
inline void add_words(report::Section& section, const report::Words& words, std::initializer_list<std::string_view> keys) {
    for (const std::string_view key : keys) add_words(section, words, key);
}
/// Appends each text as a paragraph; skips empty ones.
void add_paragraphs(report::Section& section, const std::vector<report::Text>& texts);
/// Makes the id of a table, plot, figure or file about one mesh: "q5_cube_sweep".
std::string id_of(const std::string& question, const std::string& mesh, const std::string& what);

// ---- its meshes -----------------------------------------------------------------------------------------------------------

/// Adds the mesh to the inputs of the section, once, and to its warnings those of the file and the remark that it is a decimated copy.
void enter_input(const LibraryMesh& mesh, report::Section& section);

/// Returns the meshes of the settings, else the user's own, else those of the chapter's roles, and enters them into the section.
/// @throws InputError if one is missing or unusable
LibraryMeshes meshes_for(const MeshLibrary& library, const QuestionSettings& settings, report::Section& section);
/// Returns the meshes of the settings, else the user's own, else those of `roles`, and enters them into the section.
LibraryMeshes meshes_for(const MeshLibrary& library, const QuestionSettings& settings, const std::vector<std::string_view>& roles,
                         report::Section& section);

/// Returns a failed check with the reason as its note, for a section that has to go without one of its meshes.
report::Check unusable_mesh_check(const std::string& reason);
/// Returns true if the section has an unusable_mesh_check(). Such a section is not cached: the mesh may be usable the next time.
bool misses_a_mesh(const report::Section& section);

/// Returns study_of(mesh, settings) of the meshes in order, and reports each as it begins: "denoising of cube". If a study throws an Error,
/// for example because an operator cannot be factored, the mesh becomes a failed check of `section` and has no study.
/// @throws SolverError if no mesh can be studied
template <class StudyOf>
auto studies_of(const LibraryMeshes& meshes, const std::string& work, const QuestionSettings& settings, const Progress& progress,
                report::Section& section, const StudyOf& study_of) {
    std::vector<decltype(study_of(meshes.front(), settings))> studies;
    std::string reasons;
    for (const auto& mesh : meshes) {
        progress(work + " of " + mesh->name);
        try {
            studies.push_back(study_of(mesh, settings));
        } catch (const Error& error) {
            const std::string reason = mesh->input.file + ": " + error.what();
            add(section, unusable_mesh_check(reason));
            reasons += (reasons.empty() ? "" : "; ") + reason;
        }
    }
    if (studies.empty()) throw SolverError(reasons);
    return studies;
}

/// Returns the names of the studies for which `chosen` is true.
template <class Study> Names names_where(const std::vector<Study>& studies, const auto& chosen) {
    Names names;
    for (const Study& study : studies)
        if (std::invoke(chosen, study)) names.push_back(study.name());
    return names;
}
template <class Study> Names names_of(const std::vector<Study>& studies) {
    return names_where(studies, [](const Study&) { return true; });
}

// ---- numbers --------------------------------------------------------------------------------------------------------------

auto each_of(auto&& range, const auto& f) {
    std::vector<std::remove_cvref_t<decltype(std::invoke(f, *std::begin(range)))>> values;
    for (const auto& element : range) values.push_back(std::invoke(f, element));
    return values;
}
/// Returns the largest f(element), or 0 if none is above 0; NaN is left out.
double largest_of(auto&& range, const auto& f) {
    double largest = 0;
    for (const auto& element : range) largest = std::max<double>(largest, std::invoke(f, element));
    return largest;
}

/// Returns the values in ascending order, each once: a step that the settings name twice is one run.
template <class Number> std::vector<Number> each_once(std::vector<Number> values) {
    std::sort(values.begin(), values.end());
    values.erase(std::unique(values.begin(), values.end()), values.end());
    return values;
}

/// Returns the last of the settings' values, or the question's own if there is none.
inline int last_or(const std::vector<int>& given, int own) { return given.empty() ? own : given.back(); }

/// Returns the largest values[i + 1] − values[i]; 0 if no value is above the one before it.
template <class Values> double largest_rise(const Values& values) {
    double rise = 0;
    for (auto value = values.begin(), end = values.end(); value != end && value + 1 != end; ++value)
        rise = std::max(rise, value[1] - value[0]);
    return rise;
}

std::vector<double> sorted_finite(const Vector& values);
std::vector<int> where_finite(const Vector& a, const Vector& b);

/// Spread of the finite values.
struct ValueSummary {
    double minimum = 0, maximum = 0, mean = 0, median = 0, standard_deviation = 0;
    int count = 0;       // finite values
    int undefined = 0;   // NaN or infinite
};
ValueSummary summary_of(const Vector& values);

/// Computes √(Σ A (f − g)² / Σ A g²), the relative L2 error of `f` against the truth `g`, over the vertices where both are finite.
double relative_error(const Vector& f, const Vector& g, const Vector& areas);

/// Returns a cell with the number; an empty cell if it is not finite or `defined` is false.
report::Cell cell_of(double x, bool defined = true);

inline void add_point(report::Series& series, double x, double y) {
    series.x.push_back(x);
    series.y.push_back(y);
}

// ---- words ----------------------------------------------------------------------------------------------------------------

report::Facts list_of(auto... facts) { return {std::move(facts)...}; }

/// Returns a paragraph of the sentences, joined by spaces; skips empty ones.
report::Text paragraph_of(std::initializer_list<report::Text> sentences);
/// Appends a sentence to a paragraph, after a space unless the paragraph is empty; an empty sentence changes nothing.
void go_on(report::Text& paragraph, const report::Text& sentence);

/// Returns the names as a list in words: "a", "a and b", "a, b and c"; empty without names.
std::string listed(const Names& names);
/// Returns "a; b; c".
std::string joined(const Names& parts, std::string_view separator = "; ");

/// Returns "0.3 to 0.9", or "0.3" if both are alike.
std::string span_of(const std::string& low, const std::string& high);

/// Returns the number with its noun: "1 mesh", "4 meshes", "40 962 vertices". @param plural  empty: `singular` with an s
std::string counted(int n, std::string_view singular, std::string_view plural = "");

// ---- figures of meshes ---------------------------------------------------------------------------------------------------

/// Appends a figure with this caption to answer.section, and the request to answer.figures. Without `alt`, the alternative text is made of
/// title, panels and colour range.
void add_figure(Answer& answer, output::FigureRequest request, std::string caption);
void add_figure(Answer& answer, output::FigureRequest request, std::string caption, std::string alt);

/// Returns the file name and the number of vertices: "lily.obj, 1284 vertices".
std::string subtitle_of(const LibraryMesh& mesh);

/// Makes a panel of a mesh of the library, which is not copied, or of another mesh. @param values  n values to colour; empty: none
output::Panel panel_of(const LibraryMesh& mesh, std::string name, std::string label, Vector values = {});
output::Panel panel_of(TriangleMesh mesh, std::string name, std::string label, Vector values = {});

/// Returns the triangles of `mesh` with positions (X − centre)/diagonal, centre and diagonal of the bounding box of `mesh`, so that meshes
/// of any size can stand side by side.
TriangleMesh in_unit_box(const TriangleMesh& mesh, const Positions& X);

}   // namespace meshfolio
