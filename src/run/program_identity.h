/// @file
/// What results depend on besides inputs and settings: this very program, the libraries it runs with, the kind of processor.
#pragma once

#include <string>

namespace meshfolio::run {

/// A digest of the running executable, of the names, sizes and dates of the shared libraries in use, of the processor's kind and abilities,
/// and of the variables that choose among numerical kernels. Empty where it cannot be determined. Computed once.
const std::string& program_identity();

}   // namespace meshfolio::run
