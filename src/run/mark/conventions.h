/// @file
/// Conventions by which a wrong answer differs from the right one: another sign, factor, area or operator.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "run/mark/rubric.h"

namespace meshfolio::run {

/// Conventions that together turn the right answer into the given one; empty: none. Each key has a sentence convention.<key> in
/// templates/words/mark.md; operator_<name> and area_<name> share two.
using ConventionKeys = std::vector<std::string>;

/// Returns every key that a rubric may accept.
const std::vector<std::string>& convention_keys();

/// A convention that needs the values alone, not the mesh.
struct ValueConvention {
    ConventionKeys keys;
    std::function<Vector(const Vector& right)> apply;
};
/// Returns the conventions for this quantity that need its values alone; the first is the identity, without keys.
const std::vector<ValueConvention>& value_conventions(MarkedThing what);

/// A student's values.
struct GivenValues {
    Vector values;
    Vector rounding = {};   // largest rounding error of each value, from its digits; empty: none
};

struct RightValues {
    Vector values;                    // NaN where no value is required
    double scale = 0;                 // differences below tolerance × scale never count [unit of the values]
    bool relative_to_scale = false;   // for positions: differences are compared with `scale` alone
};
/// The values that result from a convention that needs the mesh, such as another operator or area.
struct Variant {
    std::string key;
    Vector values;   // as many as right values
};

struct Agreement {
    double worst = 0;          // largest relative difference
    Eigen::Index asked = 0;    // number of right values that are not NaN
    double share = 0;          // of the asked values that agree
    Eigen::Index where = -1;   // index of the worst value
    bool agrees(double tolerance) const { return worst <= tolerance; }
};
/// Compares values by relative differences: divided by right.scale if relative_to_scale, else by |right| + the larger of the median of
/// |right| and the scale, so that neither peaks nor values near 0 decide. Rounding may explain up to 0.5 % of scale or median. A missing
/// value is infinitely far away.
Agreement agreement_of(const GivenValues& given, const RightValues& right, double tolerance);

/// Returns all sets with the fewest conventions that turn the right answer into `given` within `tolerance`; none if `given` is right or
/// nothing explains it.
/// @param variants  called only if no convention of values alone explains it
std::vector<ConventionKeys> recognised(const GivenValues& given, const RightValues& right, MarkedThing what, double tolerance,
                                       const std::function<const std::vector<Variant>&()>& variants);

}   // namespace meshfolio::run
