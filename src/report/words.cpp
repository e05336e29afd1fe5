#include "report/words.h"

#include <algorithm>
#include <map>
#include <regex>
#include <set>
#include <stdexcept>

#include "base/errors.h"
#include "base/sha256.h"
#include "report/writers.h"

namespace meshfolio::report {

namespace {

constexpr std::string_view folder = "words/", ending = ".md";

using MessagesByKey = std::map<std::string, Message, std::less<>>;
/// Messages by file and key.
using Catalogue = std::map<std::string, MessagesByKey, std::less<>>;

Catalogue catalogue_of(const Templates& templates) {
    Catalogue catalogue;
    for (const std::string& name : templates.names()) {
        if (!name.starts_with(folder)) continue;
        MessagesByKey& messages = catalogue[name.substr(folder.size(), name.size() - folder.size() - ending.size())];
        for (const Message& message : messages_of(templates[name], name)) {
            if (!messages.emplace(message.key, message).second)
                throw UsageError("the message " + message.key + " stands twice", "keep one", {name, message.line});
        }
    }
    return catalogue;
}

/// Returns the messages in use: the bundled ones, until use_words_of() replaces some.
Catalogue& catalogue() {
    static Catalogue messages = catalogue_of(Templates());
    return messages;
}

/// Returns the stored result of words_identity().
std::string& identity() {
    static std::string digest;
    return digest;
}

const Message& message_of(std::string_view file, std::string_view key) {
    const auto messages = catalogue().find(file);
    const auto message = messages == catalogue().end() ? MessagesByKey::const_iterator() : messages->second.find(key);
    if (messages == catalogue().end() || message == messages->second.end())
        throw std::logic_error("templates/words/" + std::string(file) + ".md has no message " + std::string(key));
    return message->second;
}

std::string only_paragraph(const Message& message) {
    if (message.paragraphs.size() > 1) throw std::logic_error("the message " + message.key + " has several paragraphs");
    return message.paragraphs.empty() ? "" : message.paragraphs.front();
}

/// Returns the names of counts for which the message has singular and plural.
std::set<std::string> counts_in(const Message& message) {
    static const std::regex plural("\\{\\{(\\w+)\\|");
    std::set<std::string> names;
    for (const std::string& paragraph : message.paragraphs)
        for (std::sregex_iterator it(paragraph.begin(), paragraph.end(), plural), end; it != end; ++it) names.insert((*it)[1]);
    return names;
}

/// Refuses a replaced message with other facts or plurals than the bundled one, or with markup that cannot be formatted.
void require_usable(const Message& message, const Message& own, const Location& place) {
    const auto require_among = [&](const auto& known, const auto& named, const std::string& problem) {
        for (const std::string& fact : named)
            if (std::ranges::find(known, fact) == known.end())
                throw UsageError("the message " + message.key + problem + fact, "name a fact that the bundled message has", place);
    };
    require_among(facts_in(own), facts_in(message), " has no fact ");
    require_among(counts_in(own), counts_in(message), " has no singular and plural of ");

    Facts facts;
    const std::vector<std::string> names = facts_in(message);
    for (const std::string& name : names) facts.emplace_back(name, 1);
    try {
        for (const std::string& paragraph : message.paragraphs)
            if (!paragraph.starts_with("$$")) running_text(paragraph, facts);
    } catch (const std::logic_error& problem) {
        throw UsageError(problem.what(), "close every mark, or put a backslash before it", place);
    }
}

}   // namespace

Text Words::say(std::string_view key, const Facts& facts) const { return running_text(only_paragraph(message_of(file_, key)), facts); }

std::string Words::line(std::string_view key, const Facts& facts) const {
    const Message& message = message_of(file_, key);
    const std::string paragraph = only_paragraph(message);
    if (paragraph.find("[[") != std::string::npos)
        throw UsageError("the message " + message.key + " is a caption or a label, where a reference stays as it is written",
                         "take the [[…]] out", {std::string(folder) + std::string(file_) + std::string(ending), message.line});
    return running_line(paragraph, facts);
}

std::vector<Block> Words::blocks(std::string_view key, const Facts& facts) const { return blocks_of(message_of(file_, key), facts); }

void use_words_of(const Templates& templates) {
    const Templates bundled;
    const Catalogue own = catalogue_of(bundled);
    Catalogue used = own;
    for (const auto& [file, messages] : catalogue_of(templates)) {
        for (const auto& [key, message] : messages) {
            const auto known = own.at(file).find(key);
            const std::string name = std::string(folder) + file + std::string(ending);
            if (known == own.at(file).end()) throw UsageError("there is no message " + key, "take it out", {name, message.line});
            if (message.paragraphs == known->second.paragraphs) continue;
            require_usable(message, known->second, {name, message.line});
            used[file][key] = message;
        }
    }
    catalogue() = std::move(used);
    identity().clear();
    for (const std::string& name : templates.names())
        if (name.starts_with(folder) && templates[name] != bundled[name]) identity() += name + sha256(templates[name]);
}

std::string words_identity() { return identity(); }

std::string words_documentation() {
    std::string text =
        "Words of the report, words/FILE.md: \"## key\" begins a message. {{fact}} is a value of the program, {{count|one|many}} a word\n"
        "that depends on a count; $mathematics$, **strong**, *emphasised*, `code`, [[reference]]. The facts of each message:\n\n";
    for (const auto& [file, messages] : catalogue()) {
        for (const auto& [key, message] : messages) {
            text += file + ": " + key;
            for (const std::string& fact : facts_in(message)) text += " {{" + fact + "}}";
            text += "\n";
        }
    }
    return text;
}

}   // namespace meshfolio::report
