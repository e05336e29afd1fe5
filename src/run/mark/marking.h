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
    std::string file;                          // the file that was read; empty: none
    std::string problem;                       // of an unusable file
    AnswerSettings settings;                   // that the student named
    std::vector<ConventionKeys> conventions;   // each explains the answer
    Agreement agreement;
    double given = 0, expected = 0;   // at the worst value
    Vector difference;                // per vertex, for the picture; empty: none
    const Reference* reference = nullptr;
};

struct StudentMarks {
    std::string id;                     // a safe name, unique in the class
    std::string source;                 // as on the command line
    std::vector<ItemMark> items;        // one for each item of the rubric
    std::vector<std::string> remarks;   // on answers.toml
    std::string refused;                // why nothing could be marked; empty: it was marked
    double score() const;
};

/// Returns the marks of one student's files, one for each item of the rubric. Bad files never throw: the mark of their item reports the
/// problem.
/// @throws Error if the rubric's own settings have no answer
StudentMarks marks_of(const submission::HandedIn& files, const Rubric& rubric, References& references);

}   // namespace meshfolio::run
