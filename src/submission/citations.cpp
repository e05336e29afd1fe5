#include "submission/citations.h"

namespace meshfolio::submission {

std::vector<std::string> cite(report::Document& document, const SourceListing& listing) {
    std::vector<std::string> missing;
    for (report::Section& section : document.sections) {
        for (report::CodeReference& code : section.code) {
            code.line = listing.line_of(code.function, code.file);
            if (code.line > 0) continue;
            const std::string problem = "cites " + code.function + " of " + code.file + ", which src.txt does not define";
            section.warnings.push_back(problem);
            missing.push_back(section.id + " " + problem);
        }
    }
    return missing;
}

}   // namespace meshfolio::submission
