/// @file
/// Compares one student's files with the right answers.
#pragma once

#include <string>
#include <vector>

#include "run/mark/references.h"
#include "submission/handed_in.h"

namespace meshfolio::run {

enum class Verdict { right, accepted, recognised, wrong, missing, unusable };

struct ItemMark {
    const RubricItem* item = nullptr;
    Verdict verdict = Verdict::missing;
    double score = 0;
    std::string file;                          // that was looked at; empty: none
    std::string problem;                       // of an unusable one
    AnswerSettings settings;                   // that were named
    std::vector<ConventionKeys> conventions;   // each explains the answer
    Agreement agreement;
    double given = 0, expected = 0;   // where it is worst
    Vector difference;                // one a vertex, for the picture; empty: none
    const Reference* reference = nullptr;
};

struct StudentMarks {
    std::string id;                     // a safe name of its own
    std::string source;                 // as on the command line
    std::vector<ItemMark> items;        // one for each of the rubric
    std::vector<std::string> remarks;   // on answers.toml
    std::string refused;                // why nothing could be marked; empty: it was
    double score() const;
};

/// Bad files of a student never throw: the mark of their item reports the problem.
/// @throws Error where the rubric's own settings have no answer
StudentMarks marks_of(const submission::HandedIn& files, const Rubric& rubric, References& references);

}   // namespace meshfolio::run
