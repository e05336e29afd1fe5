/// @file
/// A chapter of the report: meshes and settings in, an Answer out. Chapters write no files and draw nothing.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "output/draw/figure_request.h"
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

/// Is called while a question works; may throw to stop it.
using Progress = std::function<void(std::string_view step)>;

/// A question of the coursework, or a section that supports the answers. Its folder below src/questions defines one, named `chapter`.
struct Chapter {
    struct Code {
        std::string function, file;   // its purpose is the message "code.<function>"
    };

    std::string_view id;      // "q1"; one that is not q and a number supports the answers, and has a letter in the report
    std::vector<Code> code;   // what answers it: three definitions or more, of a question one of its own folder
    Answer (*answer)(const MeshLibrary& meshes, const QuestionSettings& settings, const Progress& progress);
    bool on_request = false;   // about earlier reports: in none that does not ask for it

    bool is_question() const { return report::is_question(id); }
    report::Words words() const { return report::Words(id); }   // templates/words/<id>.md
    std::string title() const { return words().line("title"); }
    /// The assignment's question in one sentence.
    std::string asked() const { return words().line("asked"); }
    /// Without lines; src/submission finds those.
    std::vector<report::CodeReference> cited_code() const;
};

/// All, in their order, those on request last. A new one is a folder and a line of chapter_list.cpp.
std::span<const Chapter* const> chapter_list();
/// @throws std::logic_error if none has this id
const Chapter& chapter_of_id(std::string_view id);
std::vector<std::string> section_ids();

}   // namespace meshfolio
