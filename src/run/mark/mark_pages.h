/// @file
/// Marks as files: a page and results.json for each student, class.csv and class.html for all.
#pragma once

#include <string>
#include <vector>

#include "report/writers.h"
#include "run/mark/marking.h"

namespace meshfolio::run {

/// Explains one mark as plain text, from templates/words/mark.md.
std::string explanation_of(const ItemMark& mark);

/// Returns a student's HTML page, with pictures of the differences on the mesh from six sides.
std::string student_page(const StudentMarks& marks, const Rubric& rubric, const report::Templates& templates);
/// Returns a student's marks as JSON for Gradescope's autograder: the score, and a test for each item.
std::string student_json(const StudentMarks& marks, const Rubric& rubric);
/// Returns a table with a row for each student: score and verdict of every item.
std::string class_csv(const std::vector<StudentMarks>& students, const Rubric& rubric);
/// Returns the class's HTML page: students by items, and the most frequent convention of each item.
std::string class_page(const std::vector<StudentMarks>& students, const Rubric& rubric, const report::Templates& templates);

}   // namespace meshfolio::run
