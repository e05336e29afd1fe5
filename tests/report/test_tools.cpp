#include "report/test_tools.h"

#include <regex>

namespace meshfolio::report {

std::vector<std::string> matches(const std::string& text, const std::string& expression) {
    const std::regex regex(expression);
    std::vector<std::string> found;
    for (std::sregex_iterator it(text.begin(), text.end(), regex), end; it != end; ++it) found.push_back((*it)[1]);
    return found;
}

}   // namespace meshfolio::report
