// The sentences of the report are data (templates/words), and the program and its messages know each other. Reads the sources as text.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <regex>
#include <set>
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

std::vector<fs::path> sources() {
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(questions))
        if (entry.path().extension() == ".cpp" || entry.path().extension() == ".h") files.push_back(entry.path());
    return files;
}

/// Without comments. Neighbouring literals are one, as the compiler has it.
std::string code_of(const fs::path& file) {
    static const std::regex comment("(^|[ \\t;{}])//[^\\n]*"), joint("\"\\s*\\n\\s*\"");
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

/// A sentence to people: five words or more.
int words_in(const std::string& literal) {
    static const std::regex word("[A-Za-z]{2,}");
    return static_cast<int>(std::distance(std::sregex_iterator(literal.begin(), literal.end(), word), std::sregex_iterator()));
}

}   // namespace

TEST(WordsOfQuestions, NoMessageIsUnused) {
    std::set<std::string> literals;
    for (const fs::path& file : sources())
        for (std::string& literal : literals_in(code_of(file))) literals.insert(std::move(literal));
    for (const auto& [file, messages] : all_messages()) {
        for (const report::Message& message : messages) {
            const std::string& key = message.key;
            if (key == "title" || key == "asked" || key.starts_with("code.")) continue;   // told of every chapter
            const std::size_t dot = key.rfind('.');
            const bool composed = dot != key.npos && literals.contains(key.substr(0, dot)) &&
                                  (literals.contains(key.substr(dot)) || literals.contains(key.substr(dot + 1)));
            EXPECT_TRUE(literals.contains(key) || composed) << "words/" << file << ".md: " << key;
        }
    }
}

TEST(WordsOfQuestions, NoMessageIsMissing) {
    const auto all = all_messages();
    static const std::regex declared("Words (\\w+)\\(\"(\\w+)\"\\)");
    static const std::regex used("\\b(\\w*words)(?:\\.(?:say|line|blocks)\\(|, )\"([a-z0-9_.]+)\"");
    std::map<std::string, std::string> file_of_shared;   // constants of headers that several chapters include
    for (const fs::path& file : sources()) {
        const std::string code = code_of(file);
        for (std::sregex_iterator it(code.begin(), code.end(), declared), end; it != end; ++it)
            if ((*it)[1] != "words") file_of_shared[(*it)[1]] = (*it)[2];
    }
    for (const auto& entry : fs::directory_iterator(questions)) {
        if (!entry.is_directory()) continue;
        std::string own;   // the file of `words` in this folder
        for (const auto& file : fs::directory_iterator(entry.path())) {
            const std::string code = code_of(file.path());
            std::smatch match;
            if (std::regex_search(code, match, std::regex("Words words\\(\"(\\w+)\"\\)"))) own = match[1];
        }
        for (const auto& file : fs::directory_iterator(entry.path())) {
            const std::string code = code_of(file.path());
            for (std::sregex_iterator it(code.begin(), code.end(), used), end; it != end; ++it) {
                const std::string name = (*it)[1], catalogue = name == "words" ? own : file_of_shared[name];
                if (!all.contains(catalogue)) continue;   // an argument of that name
                const auto& messages = all.at(catalogue);
                EXPECT_TRUE(std::ranges::find(messages, std::string((*it)[2]), &report::Message::key) != messages.end())
                    << file.path() << ": " << (*it)[2];
            }
        }
    }
}

TEST(WordsOfQuestions, NoPluralIsWrittenByHand) {
    std::set<std::string> plurals;
    static const std::regex chosen("\\{\\{\\w+\\|([^|}]*)\\|(\\w+)[^}]*\\}\\}"), counted("\\{\\{(\\w+)\\}\\} (\\w+)");
    const auto all = all_messages();
    const auto each_paragraph = [&](const auto& visit) {
        for (const auto& [file, messages] : all)
            for (const report::Message& message : messages)
                for (const std::string& paragraph : message.paragraphs) visit(file + ".md: " + message.key, paragraph);
    };
    each_paragraph([&](const std::string&, const std::string& text) {
        for (std::sregex_iterator it(text.begin(), text.end(), chosen), end; it != end; ++it)
            if ((*it)[1] != (*it)[2]) plurals.insert((*it)[2]);
    });
    for (const char* verb : {"are", "have", "were", "do", "their", "lie", "hold", "differ"}) plurals.erase(verb);
    EXPECT_TRUE(plurals.contains("vertices"));
    each_paragraph([&](const std::string& where, const std::string& text) {
        for (std::sregex_iterator it(text.begin(), text.end(), counted), end; it != end; ++it)
            EXPECT_FALSE(plurals.contains((*it)[2])) << where << ": {{" << (*it)[1] << "}} " << (*it)[2];
    });
}

TEST(WordsOfQuestions, NoSentenceIsLeftInTheSources) {
    static const std::regex thrown("\\w*(?:Error|error|Problem)\\([^;]*;");   // messages to programmers and of the command line
    int sentences = 0;
    for (const fs::path& file : sources()) {
        const std::string code = std::regex_replace(code_of(file), thrown, "");
        for (const std::string& literal : literals_in(code)) {
            if (words_in(literal) < 5) continue;
            ++sentences;
            ADD_FAILURE() << file.lexically_relative(questions).string() << ": " << literal;
        }
    }
    EXPECT_EQ(sentences, 0);
}
