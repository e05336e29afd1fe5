/// @file
/// What every question needs to fill its section.
#pragma once

#include <initializer_list>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "questions/core/chapter.h"
#include "report/text.h"
#include "report/words.h"

namespace meshfolio {

using namespace report::literals;

/// An empty section of the chapter `id`, with its title, what it asks and the code it cites.
report::Section section_of(std::string_view id);

/// The meshes a question works on: those of the settings, else the user's own, else these roles. Their inputs, and the
/// warnings of their preflight, are entered into the section.
/// @throws InputError if one is missing or unusable
std::vector<std::shared_ptr<const LibraryMesh>> meshes_for(const MeshLibrary& library, const QuestionSettings& settings,
                                                           std::initializer_list<std::string_view> roles, report::Section& section);

/// Says that the section has small settings, so that the report ends in time; and why one is left out.
void say_small_settings(report::Section& section);
std::string left_out_to_fit();

/// The failed check of a section that had to go without one of its meshes, and why.
report::Check unusable_mesh_check(const std::string& reason);
/// Whether such a check is there. Its answer is not cached: the mesh may be usable the next time, once it is mended or memory is free.
bool lacks_a_mesh(const report::Section& section);
/// Behind those that the section has.
void append_checks(report::Section& section, const std::vector<report::Check>& checks);

/// One mesh by its role, entered as above. The user's own mesh takes every role.
void enter_input(const LibraryMesh& mesh, report::Section& section);

// Blocks, in the order they are read.
inline void add(report::Section& section, report::Block block) { section.blocks.push_back(std::move(block)); }
/// What is added from here on is in the appendix of the report.
inline void begin_appendix(report::Section& section) { section.appendix_from = static_cast<int>(section.blocks.size()); }
/// Heading, paragraphs, formulas: whatever the message has.
void add_words(report::Section& section, const report::Words& words, std::string_view key, const report::Facts& facts);
void add_words(report::Section& section, const report::Words& words, std::string_view key, auto... facts) {
    add_words(section, words, key, report::Facts{std::move(facts)...});
}
void add_heading(report::Section& section, std::string title);
template <class... Parts>
void add_paragraph(report::Section& section, Parts&&... parts) {
    section.blocks.push_back(report::Paragraph{report::text(std::forward<Parts>(parts)...)});
}

/// Spread of the finite values.
struct ValueSummary {
    double minimum = 0, maximum = 0, mean = 0, median = 0, standard_deviation = 0;
    int count = 0;       // finite values
    int undefined = 0;   // NaN
};
ValueSummary summary_of(const Vector& values);

struct FieldError {
    double l2 = 0;     // √(Σ A (f − g)² / Σ A g²) over the vertices where both are finite; relative
    double linf = 0;   // max |f − g| / max |g|
};
/// Relative errors of `f` against the truth `g`, weighted by the areas.
FieldError relative_error(const Vector& f, const Vector& g, const Vector& areas);

/// A number in a table, or an empty cell where it is not defined (NaN, or `defined` is false).
report::Cell cell_of(double x, bool defined = true);

/// "a", "a and b", "a, b and c".
std::string listed(const std::vector<std::string>& names);

/// What was found, and under which condition: "3.4 % on cube", "at 0.5 λ_crit".
struct Observed {
    std::string what, condition;
};
/// "a, b and c, each time under x" where all conditions are the same, else "a (under x) and b (under y)".
std::string listed_observed(const std::vector<Observed>& observed);

/// "1 mesh", "4 meshes", "40 962 vertices".
std::string counted(int n, std::string_view singular, std::string_view plural = "");

}   // namespace meshfolio
