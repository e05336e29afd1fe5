/// @file
/// Conventions by which an answer can be right for another question: another sign, factor, area or operator.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "run/mark/rubric.h"

namespace meshfolio::run {

/// One or several conventions that together make the wrong answer; empty: the right one. Each has a sentence in templates/words/mark.md,
/// convention.<key>; those of operators and areas, operator_<name> and area_<name>, share two.
using ConventionKeys = std::vector<std::string>;

/// Every key that a rubric may accept.
const std::vector<std::string>& convention_keys();

/// Maps right values to those with the convention, without the mesh.
struct ValueConvention {
    ConventionKeys keys;
    std::function<Vector(const Vector& right)> apply;
};
/// Known factors and signs for this quantity; the first is the identity.
const std::vector<ValueConvention>& value_conventions(MarkedThing what);

/// Values of a student.
struct GivenValues {
    Vector values;
    Vector rounding = {};   // largest rounding error of each value, from its digits; empty: none
};

/// The right values; NaN where none is required.
struct RightValues {
    Vector values;
    double scale = 0;                 // a difference of `tolerance` of it never counts [as values]
    bool relative_to_scale = false;   // for positions, whose own size says nothing: nothing else counts
};
/// The right values with one of the conventions that need the mesh: another operator, another area, …
struct Variant {
    std::string key;
    Vector values;   // as many
};

struct Agreement {
    double worst = 0;          // largest difference, over what counts as the size there: within the tolerance, it agrees
    Eigen::Index asked = 0;    // values that are defined
    double share = 0;          // of the values asked for, how many agree
    Eigen::Index where = -1;   // that of `worst`
    bool agrees(double tolerance) const { return worst <= tolerance; }
};
/// Each difference over |right| + the median of all |right|, so that neither a few peaks nor values near 0 decide. Of a difference only
/// what rounding does not explain counts, and rounding explains up to 0.5 % of that median: three digits must be left. A value that is
/// missing is infinitely far away.
Agreement agreement_of(const GivenValues& given, const RightValues& right, double tolerance);

/// All smallest sets of conventions with which `given` agrees; none where none does, or where it is right.
/// @param variants  asked for only where no value convention alone explains it
std::vector<ConventionKeys> recognised(const GivenValues& given, const RightValues& right, MarkedThing what, double tolerance,
                                       const std::function<const std::vector<Variant>&()>& variants);

}   // namespace meshfolio::run
