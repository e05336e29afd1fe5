#include "questions/core/study_list.h"

namespace meshfolio {

std::string id_of(const std::string& question, const std::string& mesh, const std::string& what) {
    return question + "_" + mesh + "_" + what;
}

void add_paragraphs(report::Section& section, std::initializer_list<report::Text> texts) {
    for (const report::Text& text : texts) {
        if (!text.empty()) section.blocks.push_back(report::Paragraph{text});
    }
}

}   // namespace meshfolio
