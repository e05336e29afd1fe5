#include "mesh/io/obj_statements.h"

namespace meshfolio {

namespace {

bool ends_in_backslash(std::string_view line) {
    const std::size_t last = line.find_last_not_of(" \t");
    return last != std::string_view::npos && line[last] == '\\';
}

}   // namespace

bool ObjStatements::next() {
    if (!lines_.next_with_words()) return false;
    line_ = lines_.number();
    statement_ = lines_.line();
    begin_ = static_cast<std::size_t>(statement_.data() - start_);
    if (!ends_in_backslash(statement_)) return true;
    joined_.clear();
    std::string_view part = statement_;
    while (ends_in_backslash(part)) {
        joined_.append(part.substr(0, part.find_last_of('\\'))).push_back(' ');
        if (!lines_.next()) {
            cut_off_ = true;
            part = {};
            break;
        }
        part = without_comment(lines_.line());
    }
    statement_ = joined_.append(part);
    return true;
}

}   // namespace meshfolio
