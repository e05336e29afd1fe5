/// @file
/// Operators that are taken for the right one.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "run/mark/rubric.h"

namespace meshfolio::run {

using OperatorOf = std::function<LaplaceBeltrami(const TriangleMesh&)>;

struct WrongLaplacian {
    std::string key;                           // of the convention
    OperatorKind kind = OperatorKind::cotan;   // the uniform one makes a curvature in its own way
    OperatorOf of;
};

/// Those of the operator laboratory but the right one, and what is made of that by wrong areas.
std::vector<WrongLaplacian> wrong_laplacians(const AnswerSettings& s);

}   // namespace meshfolio::run
