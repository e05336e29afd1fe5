#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>

#include "base/file_bytes.h"
#include "report/bibliography.h"
#include "report/test_tools.h"
#include "report/words.h"
#include "report/writers.h"
#include "source_dir.h"

namespace meshfolio::report {
namespace {

using Json = nlohmann::ordered_json;

const std::string formulas_file = MESHFOLIO_SOURCE_DIR "/templates/formulas.json";

void replace_all(std::string& text, const std::string& from, const std::string& to) {
    for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size())) text.replace(at, from.size(), to);
}

/// MathML of all formulas by one run of pandoc, in their order.
std::vector<std::string> mathml_by_pandoc(const Json& formulas) {
    const TemporaryFolder folder;
    std::string source;
    for (const auto& [name, forms] : formulas.items()) source += "$$" + forms["tex"].get<std::string>() + "$$\n\n";
    const auto in = folder.write("formulas.md", source), out = folder.path() / "formulas.html";
    EXPECT_TRUE(succeeds("pandoc -f markdown -t html --mathml --wrap=none '" + in.string() + "' -o '" + out.string() + "'"));
    const std::string html = read_file(out);
    std::vector<std::string> found;
    for (std::size_t at = html.find("<math "); at != std::string::npos; at = html.find("<math ", at + 1)) {
        found.push_back(html.substr(at, html.find("</math>", at) + 7 - at));
        // U+2225 is the relation "parallel" and gets a relation's spaces; the fence is U+2016. Capital Greek is upright.
        replace_all(found.back(), "∥", "‖");
        for (const std::string capital : {"Δ", "Φ"})
            replace_all(found.back(), "<mi>" + capital + "</mi>", "<mi mathvariant=\"normal\">" + capital + "</mi>");
    }
    return found;
}

// Set MESHFOLIO_UPDATE to write the MathML of new or changed formulas.
TEST(Formulas, MathmlIsWhatPandocMakesOfTheTex) {
    if (!has_program("pandoc")) GTEST_SKIP() << "pandoc is not installed";
    Json formulas = Json::parse(read_file(formulas_file));
    const auto regenerated = mathml_by_pandoc(formulas);
    ASSERT_EQ(regenerated.size(), formulas.size());
    std::size_t i = 0;
    for (auto& [name, forms] : formulas.items()) {
        if (std::getenv("MESHFOLIO_UPDATE") == nullptr) {
            EXPECT_EQ(forms["mathml"].get<std::string>(), regenerated[i]) << name << ": set MESHFOLIO_UPDATE to write it";
        }
        forms["mathml"] = regenerated[i++];
    }
    if (std::getenv("MESHFOLIO_UPDATE") != nullptr) write_file(formulas_file, formulas.dump(2) + "\n");
}

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
