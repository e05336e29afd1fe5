/// @file
/// A question of the coursework: meshes and settings in, an Answer out. Questions write no files and draw nothing.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "output/figure_request.h"
#include "questions/mesh_library.h"
#include "questions/settings.h"
#include "report/document.h"

namespace meshfolio {

struct Answer {
    report::Section section;
    std::vector<output::FigureRequest> figures;
    std::vector<output::MeshOutput> meshes;
};

/// Told as a question works; may throw to stop it.
using Progress = std::function<void(std::string_view step)>;

struct Question {
    std::string_view id;   // "q1"
    std::string_view title;
    std::string_view asked;   // the assignment's question in one sentence
    Answer (*answer)(const MeshLibrary& meshes, const QuestionSettings& settings, const Progress& progress);
};

/// The seven, in order. A new question is one file and one line of question_list.cpp.
std::span<const Question> question_list();
/// What the answers rest on: sections of the same kind that follow the seven, with letters.
std::span<const Question> supporting_list();
/// The one of either list with this id, or null.
const Question* question_of_id(std::string_view id);
/// The ids of both lists, in order.
std::vector<std::string> section_ids();

Answer answer_q1(const MeshLibrary&, const QuestionSettings&, const Progress&);
Answer answer_q2(const MeshLibrary&, const QuestionSettings&, const Progress&);
Answer answer_q3(const MeshLibrary&, const QuestionSettings&, const Progress&);
Answer answer_q4(const MeshLibrary&, const QuestionSettings&, const Progress&);
Answer answer_q5(const MeshLibrary&, const QuestionSettings&, const Progress&);
Answer answer_q6(const MeshLibrary&, const QuestionSettings&, const Progress&);
Answer answer_q7(const MeshLibrary&, const QuestionSettings&, const Progress&);
Answer answer_truth(const MeshLibrary&, const QuestionSettings&, const Progress&);
Answer answer_stability(const MeshLibrary&, const QuestionSettings&, const Progress&);
Answer answer_maps(const MeshLibrary&, const QuestionSettings&, const Progress&);
Answer answer_modes(const MeshLibrary&, const QuestionSettings&, const Progress&);
Answer answer_prediction(const MeshLibrary&, const QuestionSettings&, const Progress&);
Answer answer_methods(const MeshLibrary&, const QuestionSettings&, const Progress&);
Answer answer_operators(const MeshLibrary&, const QuestionSettings&, const Progress&);
Answer answer_reproductions(const MeshLibrary&, const QuestionSettings&, const Progress&);
Answer answer_claims(const MeshLibrary&, const QuestionSettings&, const Progress&);
Answer answer_certificates(const MeshLibrary&, const QuestionSettings&, const Progress&);
Answer answer_preflight(const MeshLibrary&, const QuestionSettings&, const Progress&);

}   // namespace meshfolio
