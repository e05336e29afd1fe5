/// @file
/// A chapter of the report: meshes and settings in, an Answer out. Chapters write no files and draw nothing.
#pragma once

#include <cmath>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "output/draw/figure_request.h"
#include "questions/core/mesh_library.h"
#include "questions/core/settings.h"
#include "report/document.h"
#include "report/words.h"

namespace meshfolio {

namespace report {
bool is_question(std::string_view section_id);   // numbering.h
}

struct Answer {
    report::Section section;
    std::vector<output::FigureRequest> figures = {};
    std::vector<output::MeshOutput> meshes = {};
};

/// Called with the name of each step as it begins, “denoising of cube”; may throw to stop the chapter.
using Progress = std::function<void(std::string_view step)>;

/// fixed + Σ over the meshes of (linear x + growing x^(3/2)), x in 100,000 vertices: the power is that of a sparse factor.
struct CostModel {
    double fixed, linear, growing = 0;

    /// Returns work · (linear x + growing x^(3/2)) for one mesh, x = vertices / 100,000; `fixed` is not included.
    double per_mesh(double vertices, double work = 1) const {
        const double x = vertices / 1e5;
        return work * (linear * x + growing * x * std::sqrt(x));
    }
};

/// A full setting and the small one of --quick.
struct FullAndSmall {
    CostModel full, small;
};

/// The cost of a chapter, figures included. tests/bench/fit_costs.py measures meshes of 2,000 to 30,000 vertices and prints the rows.
struct ChapterCost {
    FullAndSmall cpu;               // [s]
    FullAndSmall memory;            // [MB], beyond the meshes
    CostModel whole_cpu = {0, 0};   // [s], of work on the whole meshes where the rest works on decimated copies
    /// Default length of a run and default number of runs, full and small. A [[question]] of a settings file that asks for more costs more.
    std::vector<int> QuestionSettings::*lengths = nullptr;
    double length[2] = {1, 1}, runs[2] = {1, 1};
    bool is_guess = false;   // the chapter gives none

    /// Returns (longest run / default length) × (number of λ × number of σ / default number of runs); a factor whose lists are empty is 1,
    /// and everything is 1 if `lengths` is null. @param small  compare with the defaults of --quick
    double work_of(const QuestionSettings& settings, bool small) const;
};

/// The cost of a chapter that gives none: that of a dear question.
inline constexpr ChapterCost guessed_cost{.cpu = {{1, 40, 20}, {0.3, 10, 8}}, .memory = {{20, 400}, {10, 200}}, .is_guess = true};

struct LabOffer;

/// A question of the coursework, or a section that supports the answers: everything that the program knows of it. Its folder below
/// src/questions defines one, named `chapter`.
struct Chapter {
    struct Code {
        std::string function, file;   // the message "code.<function>" says its purpose
    };

    std::string_view id;      // "q1"; a supporting section has another name, and a letter in the report
    std::vector<Code> code;   // at least three definitions that answer it; a question cites one of its own folder
    /// Roles of all meshes that it may read where the user names none, in order; the first `planned_roles` of them decide its cost.
    std::vector<std::string_view> roles = {};
    std::size_t planned_roles = roles.size();
    ChapterCost cost = guessed_cost;
    Answer (*answer)(const MeshLibrary& meshes, const QuestionSettings& settings, const Progress& progress);
    const LabOffer* lab = nullptr;   // its panel of the live laboratory; null: none
    /// Values that `batch` takes: the key of each, and the column of this chapter's tables (or the table) that has it, without the id.
    std::vector<std::pair<std::string_view, std::string_view>> batch = {};
    bool never_left_out = false;     // also where the time is short; true of every question
    bool verifies_program = false;   // `meshfolio verify` runs it

    bool is_question() const { return report::is_question(id); }
    report::Words words() const { return report::Words(id); }   // templates/words/<id>.md
    std::string title() const { return words().line("title"); }
    /// Returns the assignment's question in one sentence.
    std::string asked() const { return words().line("asked"); }
    /// Returns `code` with the words for its purposes, without line numbers, which src/submission finds.
    std::vector<report::CodeReference> cited_code() const;
};

/// Returns all chapters in the order of the report. A new chapter is a folder and a line of chapter_list.cpp.
std::span<const Chapter* const> chapter_list();
/// Returns the chapter with this id. @throws std::logic_error if there is none
const Chapter& chapter_of_id(std::string_view id);
/// Returns the ids of chapter_list(), in its order: "q1", … "certificates".
std::vector<std::string> section_ids();

}   // namespace meshfolio
