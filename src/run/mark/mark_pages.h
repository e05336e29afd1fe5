/// @file
/// Marks as files: a page and results.json a student, class.csv for all.
#pragma once

#include <string>
#include <vector>

#include "report/writers.h"
#include "run/mark/marking.h"

namespace meshfolio::run {

/// What is said of one answer, plain, from templates/words/mark.md.
std::string said_of(const ItemMark& mark);

/// The difference on the mesh, from six sides, as JPEG; empty where there is none to be drawn.
std::string picture_of(const ItemMark& mark);
/// The file of that picture, beside the page.
std::string picture_file(const ItemMark& mark);

std::string student_page(const StudentMarks& marks, const Rubric& rubric, const report::Templates& templates);
/// As Gradescope's autograder reads it: score, tests with score, max_score, status and output.
std::string student_json(const StudentMarks& marks, const Rubric& rubric);
/// One row a student.
std::string class_csv(const std::vector<StudentMarks>& students, const Rubric& rubric);

}   // namespace meshfolio::run
