#include "report/brief_number.h"

#include <cmath>

#include "base/number_text.h"

namespace meshfolio::report {

std::string readable_integer(double x) { return std::isfinite(x) ? readable_count(std::llround(x)) : readable(x); }

std::string brief(double x, int most) {
    const std::string wanted = plain_text(x, most);   // without trailing zeros
    for (int digits = 1; digits < most; ++digits)
        if (plain_text(x, digits) == wanted) return readable(x, digits);
    return readable(x, most);
}

}   // namespace meshfolio::report
