#include <gtest/gtest.h>

#include <set>

#include "report/bibliography.h"
#include "report/words.h"
#include "report/writers.h"

namespace meshfolio::report {
namespace {

TEST(Formulas, EachHasItsThreeForms) {
    const auto formulas = formulas_of(Templates());
    EXPECT_FALSE(formulas.empty());
    for (const auto& [name, forms] : formulas) {
        EXPECT_FALSE(forms.tex.empty()) << name;
        EXPECT_FALSE(forms.plain.empty()) << name;
        EXPECT_EQ(forms.mathml.find("<math display=\"block\""), 0u) << name;
        EXPECT_EQ(forms.plain.find('\\'), std::string::npos) << name;
    }
}

TEST(Formulas, AreThoseOfTheWords) {
    const Templates templates;
    const auto formulas = formulas_of(templates);
    std::set<std::string> shown;
    for (const std::string& file : templates.names()) {
        if (!file.starts_with("words/")) continue;
        for (const Message& message : messages_of(templates[file], file)) {
            for (const std::string& paragraph : message.paragraphs) {
                if (!paragraph.starts_with("$$ ")) continue;
                const std::string name = paragraph.substr(3, paragraph.find(' ', 3) - 3);
                EXPECT_TRUE(formulas.contains(name)) << file << ", " << message.key << ": " << name << " is not in templates/formulas.json";
                shown.insert(name);
            }
        }
    }
    for (const auto& [name, forms] : formulas) EXPECT_TRUE(shown.contains(name)) << name << " stands in no words: delete it";
}

TEST(Bibliography, IdsAreUniqueAndEntriesComplete) {
    std::set<std::string> ids;
    for (const CitedWork& work : bibliography_of(Templates())) {
        EXPECT_TRUE(ids.insert(work.id).second) << work.id;
        EXPECT_EQ(work.id.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_"), std::string::npos) << work.id;
        for (const std::string* part : {&work.authors, &work.title, &work.where}) EXPECT_FALSE(part->empty()) << work.id;
        EXPECT_EQ(work.year.size(), 4u) << work.id;
    }
    EXPECT_GE(ids.size(), 18u);
}

}   // namespace
}   // namespace meshfolio::report
