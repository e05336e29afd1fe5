// The sentences of the report are data (templates/words), and the program and its messages know each other. Reads the sources as text.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "base/file_bytes.h"
#include "report/words.h"
#include "report/writers.h"
#include "source_dir.h"

using namespace meshfolio;
namespace fs = std::filesystem;

namespace {

const fs::path questions = fs::path(MESHFOLIO_SOURCE_DIR) / "src/questions";

std::vector<fs::path> sources(const fs::path& folder = questions) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (entry.path().extension() == ".cpp" || entry.path().extension() == ".h") files.push_back(entry.path());
    return files;
}

/// Without comments. Neighbouring literals are one, as the compiler has it.
std::string code_of(const fs::path& file) {
    static const std::regex comment("(^|[\\s;{}])//[^\\n]*"), joint("\"\\s*\\n\\s*\"");
    return std::regex_replace(std::regex_replace(read_file(file), comment, "$1"), joint, "");
}

std::vector<std::string> literals_in(const std::string& code) {
    static const std::regex literal("\"((?:[^\"\\\\]|\\\\.)*)\"");
    std::vector<std::string> literals;
    for (std::sregex_iterator it(code.begin(), code.end(), literal), end; it != end; ++it) literals.push_back((*it)[1]);
    return literals;
}

/// "q3" → its messages.
std::map<std::string, std::vector<report::Message>> all_messages() {
    std::map<std::string, std::vector<report::Message>> messages;
    const report::Templates templates;
    for (const std::string& name : templates.names())
        if (name.starts_with("words/")) messages[name.substr(6, name.size() - 9)] = report::messages_of(templates[name], name);
    return messages;
}

/// Is the key a literal, or put together from literals and numbers at its dots?
bool is_spelt_by(const std::set<std::string>& literals, const std::string& key) {
    const bool number = !key.empty() && key.find_first_not_of("0123456789") == key.npos;
    if (number || literals.contains(key) || literals.contains(key + ".") || literals.contains("." + key) ||
        literals.contains("." + key + "."))
        return true;
    for (std::size_t dot = key.find('.'); dot != key.npos; dot = key.find('.', dot + 1))
        if (is_spelt_by(literals, key.substr(0, dot)) && is_spelt_by(literals, key.substr(dot + 1))) return true;
    return false;
}

/// How many words of two letters or more are separated by blanks; paths and names of code are none.
int words_in(const std::string& literal) {
    std::istringstream stream(literal);
    int count = 0;
    for (std::string word; stream >> word;) {
        const auto letters = std::ranges::count_if(word, [](unsigned char c) { return std::isalpha(c) != 0; });
        count += letters >= 2 && word.find_first_of("/_") == word.npos ? 1 : 0;
    }
    return count;
}

}   // namespace

TEST(WordsOfQuestions, NoMessageIsUnused) {
    std::set<std::string> literals;
    std::vector<fs::path> files = sources();
    for (const char* folder : {"src/run/mark", "src/run/one_mesh", "src/run/settings"})
        for (fs::path& file : sources(fs::path(MESHFOLIO_SOURCE_DIR) / folder)) files.push_back(std::move(file));
    for (const fs::path& file : files)
        for (std::string& literal : literals_in(code_of(file))) {
            literals.insert(literal);
            std::ranges::replace(literal, '-', '_');
            literals.insert(std::move(literal));
        }
    for (const auto& [file, messages] : all_messages()) {
        for (const report::Message& message : messages) {
            const std::string& key = message.key;
            if (key == "title" || key == "asked" || key.starts_with("code.")) continue;   // told of every chapter
            EXPECT_TRUE(is_spelt_by(literals, key))
                << "words/" << file << ".md: " << key << " is said nowhere. Take it out, or spell its key, whole or dot by dot, in C++";
        }
    }
}

TEST(WordsOfQuestions, NoMessageIsMissing) {
    const auto all = all_messages();
    static const std::regex declared("Words (\\w+)\\(\"(\\w+)\"\\)");
    static const std::regex used("\\b(\\w*words)(?:\\.(?:say|line|blocks)\\(|, )\"([a-z0-9_.]*[a-z0-9_])\"");
    std::map<std::string, std::string> file_of_shared;   // constants of headers that several chapters include
    for (const fs::path& file : sources()) {
        const std::string code = code_of(file);
        for (std::sregex_iterator it(code.begin(), code.end(), declared), end; it != end; ++it)
            if ((*it)[1] != "words") file_of_shared[(*it)[1]] = (*it)[2];
    }
    for (const auto& entry : fs::directory_iterator(questions)) {
        if (!entry.is_directory()) continue;
        std::vector<fs::path> of_chapter;
        for (const auto& file : fs::recursive_directory_iterator(entry.path()))
            if (file.is_regular_file()) of_chapter.push_back(file.path());
        std::string own;   // the file of `words` in this folder
        for (const fs::path& file : of_chapter) {
            const std::string code = code_of(file);
            std::smatch match;
            if (std::regex_search(code, match, std::regex("Words words\\(\"(\\w+)\"\\)"))) own = match[1];
        }
        for (const fs::path& file : of_chapter) {
            const std::string code = code_of(file);
            for (std::sregex_iterator it(code.begin(), code.end(), used), end; it != end; ++it) {
                const std::string name = (*it)[1], catalogue = name == "words" ? own : file_of_shared[name];
                if (!all.contains(catalogue)) continue;   // an argument of that name
                const auto& messages = all.at(catalogue);
                EXPECT_TRUE(std::ranges::find(messages, std::string((*it)[2]), &report::Message::key) != messages.end())
                    << file << ": " << (*it)[2] << " is no message of templates/words/" << catalogue << ".md";
            }
        }
    }
}

TEST(WordsOfQuestions, NoSentenceIsLeftInTheSources) {
    static const std::regex thrown(
        "\\w*(?:Error|error|Problem|progress)\\([^;]*;|\\[[^\\]\\n]*\\](?=\")");   // what failed, what is being done, and units
    int sentences = 0;
    for (const fs::path& file : sources()) {
        const std::string code = std::regex_replace(code_of(file), thrown, "");
        for (const std::string& literal : literals_in(code)) {
            if (words_in(literal) < 6) continue;   // names of columns, units and steps of the work are shorter
            ++sentences;
            ADD_FAILURE() << file.lexically_relative(questions).string() << ": \"" << literal
                          << "\" is a sentence: make it a message of templates/words";
        }
    }
    EXPECT_EQ(sentences, 0);
}

TEST(WordsOfQuestions, NoPluralIsWrittenByHand) {
    // "{{vertices}} vertices" is wrong for 1. "Mean edge" is a unit and has no plural.
    static const std::regex by_hand(
        "\\{\\{\\w+\\}\\}\\s+(?:explicit |implicit |random |such |open )?(?:vertices|triangles|faces|edges|meshes|modes|iterations|steps|"
        "operators|surfaces|estimators|refinements|rings|checks|components|eigenvalues|kinds|points|methods|seeds|runs|claims)\\b");
    static const std::set<std::string> adjectives{
        "{{kind}} meshes",    "{{triangulation}} meshes",  "{{triangles}} triangles",         "{{counts}} iterations",
        "{{classes}} meshes", "{{meshes}} implicit steps", "{{factorisation}} implicit steps"};
    for (const auto& [file, messages] : all_messages()) {
        for (const report::Message& message : messages) {
            for (const std::string& paragraph : message.paragraphs) {
                for (std::sregex_iterator it(paragraph.begin(), paragraph.end(), by_hand), end; it != end; ++it)
                    EXPECT_TRUE(adjectives.contains(it->str())) << "words/" << file << ".md, " << message.key << ": " << it->str()
                                                                << " is wrong for one: write {{n}} {{n|mesh|meshes}}";
            }
        }
    }
}
