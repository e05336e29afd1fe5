/// @file
/// Marks as files: a page and results.json for each student, class.csv and class.html for all.
#pragma once

#include <string>
#include <vector>

#include "report/writers.h"
#include "run/mark/marking.h"

namespace meshfolio::run {

/// Returns the explanation of one mark for the student, as plain text from templates/words/mark.md.
std::string explanation_of(const ItemMark& mark);

/// Returns a student's HTML page, with pictures of the differences on the mesh from six sides.
std::string student_page(const StudentMarks& marks, const Rubric& rubric, const report::Templates& templates);
/// Returns a student's marks as JSON for Gradescope's autograder: the score, and a test for each item.
std::string student_json(const StudentMarks& marks, const Rubric& rubric);
/// Returns CSV with a row for each student: name, submission, score, largest score, score and verdict of every item, remarks.
std::string class_csv(const std::vector<StudentMarks>& students, const Rubric& rubric);
/// Returns the HTML page of the class: a table of students by items, and for each item its average and its most frequent convention.
std::string class_page(const std::vector<StudentMarks>& students, const Rubric& rubric, const report::Templates& templates);

}   // namespace meshfolio::run
