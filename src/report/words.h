/// @file
/// The sentences of the report as data: templates/words/<chapter>.md. Questions compute facts and choose keys; what is said of them stands
/// there, and `report --templates` replaces it. A heading "## key" begins a message, lines that follow one another are one paragraph, and a
/// line "# …" is a remark:
///
///     ## limit.spot
///     The limit is set at {{vertices}} {{vertices|vertex|vertices}} of {{mesh}}, where $λ_crit$ is smallest ([[q5_limits]]).
///
/// {{name}} is a fact, {{name|one|many}} the word that goes with a count. {{#name}}…{{/name}} is told if the fact holds: a count or a truth
/// above 0, words that are not empty; {{^name}}…{{/name}} if it does not. A list of facts is told once an entry, with the facts of that
/// entry. In running text $…$ is mathematics, **…** strong, *…* emphasised, `…` code, [[…]] a reference; a backslash takes the meaning from
/// the character behind it. In messages taken as blocks, "### Title" is a heading, "$$ name id $$" a displayed formula of formulas.json,
/// lines that begin with "- " are a list, and a paragraph of which nothing is told is left out.
#pragma once

#include <concepts>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "report/document.h"

namespace meshfolio::report {

class Templates;

struct Fact;
using Facts = std::vector<Fact>;
using FactList = std::vector<Facts>;

/// A fact that a sentence states: words; running text; a count, which also chooses between singular and plural; whether something holds;
/// or a list, whose section is told once an entry.
struct Fact {
    std::string_view name;
    std::variant<std::string, Text, long long, FactList> value;

    Fact(std::string_view fact, std::string words) : name(fact), value(std::move(words)) {}
    Fact(std::string_view fact, const char* words) : name(fact), value(std::string(words)) {}
    Fact(std::string_view fact, std::string_view words) : name(fact), value(std::string(words)) {}
    Fact(std::string_view fact, Text words) : name(fact), value(std::move(words)) {}
    Fact(std::string_view fact, std::integral auto count) : name(fact), value(static_cast<long long>(count)) {}
    Fact(std::string_view fact, FactList entries) : name(fact), value(std::move(entries)) {}
};

/// "mesh"_a = name: a fact by its name, in the manner of fmt.
struct FactName {
    std::string_view name;
    template <class Value>
    Fact operator=(Value&& value) const {
        return {name, std::forward<Value>(value)};
    }
};
inline namespace literals {
constexpr FactName operator""_a(const char* name, std::size_t length) { return {{name, length}}; }
}   // namespace literals

/// The messages of one file of templates/words.
class Words {
public:
    /// @param file  without folder and ending: "q5"
    explicit constexpr Words(std::string_view file) : file_(file) {}

    /// Running text: the paragraph of this key, with its markup.
    /// @throws std::logic_error if there is no such key, or the message names a fact that is not given
    Text say(std::string_view key, const Facts& facts) const;
    /// words.say("limit.spot", "mesh"_a = name, "vertices"_a = 3)
    Text say(std::string_view key, auto... facts) const { return say(key, Facts{std::move(facts)...}); }
    /// The same as it stands, without markup: captions, titles, labels, names of checks.
    std::string line(std::string_view key, const Facts& facts) const;
    std::string line(std::string_view key, auto... facts) const { return line(key, Facts{std::move(facts)...}); }
    /// Paragraphs, headings, formulas and lists of this key, in their order.
    std::vector<Block> blocks(std::string_view key, const Facts& facts) const;

private:
    std::string_view file_;
};

/// Replaces the messages by those of the files "words/…" of these templates. Not thread-safe.
/// @throws UsageError for a message that the program does not know, or that names other facts than its own message does, with file and line
void use_words_of(const Templates& templates);

/// A digest of replaced messages; empty if none is replaced.
std::string words_identity();

/// Lists all messages for people: one line each, with the names of its facts.
std::string words_documentation();

/// One message of a file: "limit.spot", and what stands below it, line by line.
struct Message {
    std::string key;
    std::vector<std::string> paragraphs;   // lines joined; of lists and formulas one each
    long line = 0;
};
/// @throws UsageError naming file and line where the text is no list of messages
std::vector<Message> messages_of(std::string_view text, const std::string& file);
/// One paragraph of a message with its facts.
/// @throws std::logic_error if a fact is missing, or a mark is not closed
Text running_text(std::string_view paragraph, const Facts& facts);
/// The same as a caption or a label: marks of markup stand for themselves.
std::string running_line(std::string_view paragraph, const Facts& facts);
/// Each of its paragraphs as what it is: a heading, a formula, a bullet or running text.
std::vector<Block> blocks_of(const Message& message, const Facts& facts);
/// The names between {{ and }} or |, each once, sorted.
std::vector<std::string> facts_in(const Message& message);
/// The names of its sections, each once, sorted.
std::vector<std::string> sections_in(const Message& message);

}   // namespace meshfolio::report
