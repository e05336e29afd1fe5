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

namespace meshfolio {

struct Answer {
    report::Section section;
    std::vector<output::FigureRequest> figures;
    std::vector<output::MeshOutput> meshes;
};

/// Told as a question works; may throw to stop it.
using Progress = std::function<void(std::string_view step)>;

/// A question of the coursework, or a section that supports the answers. Its folder below src/questions defines one, named `chapter`.
struct Chapter {
    std::string_view id;   // "q1"; one that is not q and a number supports the answers, and has a letter in the report
    std::string_view title;
    std::string_view asked;                    // the assignment's question in one sentence
    std::vector<report::CodeReference> code;   // what answers it, without lines; src/submission finds those
    Answer (*answer)(const MeshLibrary& meshes, const QuestionSettings& settings, const Progress& progress);

    bool is_question() const { return report::is_question(id); }
};

/// All, in their order. A new one is a folder and a line of chapter_list.cpp.
std::span<const Chapter* const> chapter_list();
/// @throws std::logic_error if none has this id
const Chapter& chapter_of_id(std::string_view id);
/// Of all, in order.
std::vector<std::string> section_ids();

}   // namespace meshfolio
