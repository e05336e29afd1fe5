/// @file
/// Marks as files: a page and results.json a student, class.csv and class.html for all.
#pragma once

#include <string>
#include <vector>

#include "report/writers.h"
#include "run/mark/marking.h"

namespace meshfolio::run {

/// The explanation of one mark as plain text, from templates/words/mark.md.
std::string said_of(const ItemMark& mark);

/// With the differences on the mesh, drawn from six sides: one file.
std::string student_page(const StudentMarks& marks, const Rubric& rubric, const report::Templates& templates);
/// As Gradescope's autograder reads it: score, tests with score, max_score, status and output.
std::string student_json(const StudentMarks& marks, const Rubric& rubric);
/// One row a student.
std::string class_csv(const std::vector<StudentMarks>& students, const Rubric& rubric);
/// The same as a page: students by items, and what went wrong most often with each item.
std::string class_page(const std::vector<StudentMarks>& students, const Rubric& rubric, const report::Templates& templates);

}   // namespace meshfolio::run
