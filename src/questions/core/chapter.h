/// @file
/// A chapter of the report: meshes and settings in, an Answer out. Chapters write no files and draw nothing.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "output/draw/figure_request.h"
#include "questions/core/cost.h"
#include "questions/core/mesh_library.h"
#include "questions/core/settings.h"
#include "report/document.h"
#include "report/numbering.h"
#include "report/words.h"

namespace meshfolio {

struct Answer {
    report::Section section;
    std::vector<output::FigureRequest> figures = {};
    std::vector<output::MeshOutput> meshes = {};
};

struct LabOffer;

/// Called while a chapter works; may throw to stop it.
using Progress = std::function<void(std::string_view step)>;

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
    ChapterCost cost;
    Answer (*answer)(const MeshLibrary& meshes, const QuestionSettings& settings, const Progress& progress);
    const LabOffer* lab = nullptr;   // its panel of the live laboratory; null: none
    bool on_request = false;         // about earlier reports: only in a report that asks for it
    bool never_left_out = false;     // also where the time is short; true of every question
    bool verifies_program = false;   // `meshfolio verify` runs it

    bool is_question() const { return report::is_question(id); }
    report::Words words() const { return report::Words(id); }   // templates/words/<id>.md
    std::string title() const { return words().line("title"); }
    /// The assignment's question in one sentence.
    std::string asked() const { return words().line("asked"); }
    /// Returns the cited code without line numbers, which src/submission finds.
    std::vector<report::CodeReference> cited_code() const;
};

/// All, in their order, those on request last. A new one is a folder and a line of chapter_list.cpp.
std::span<const Chapter* const> chapter_list();
/// @throws std::logic_error if none has this id
const Chapter& chapter_of_id(std::string_view id);
std::vector<std::string> section_ids();

}   // namespace meshfolio
