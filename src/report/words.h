/// @file
/// The sentences of the report are data: templates/words/<chapter>.md, which `report --templates` can replace. Chapters compute facts and
/// choose messages by their keys. A heading "## key" begins a message, consecutive lines are one paragraph, and a line "# …" is a remark:
///
///     ## limit.spot
///     The limit is set at {{vertices}} {{vertices|vertex|vertices}} of {{mesh}}, where $λ_crit$ is smallest ([[q5_limits]]).
///
/// {{name}} is a fact, {{name|one|many}} a word that depends on a count. The section {{#name}}…{{/name}} is included if the fact holds (a
/// count above 0, true, words that are not empty), {{^name}}…{{/name}} if it does not; a list repeats its section for each entry, with the
/// facts of that entry. In running text $…$ is mathematics, **…** strong, *…* emphasised, `…` code and [[…]] a reference; a backslash makes
/// the next character plain. In messages taken as blocks, "### Title" is a heading, "$$ name id $$" a displayed formula of formulas.json,
/// lines that begin with "- " are a list, and empty paragraphs are left out.
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

/// A named value of a message: words, running text, a count or truth value, or a list of facts for each entry.
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

/// Makes a fact from a name and a value: "mesh"_a = name.
struct FactName {
    std::string_view name;
    template <class Value> Fact operator=(Value&& value) const { return {name, std::forward<Value>(value)}; }
};
inline namespace literals {
constexpr FactName operator""_a(const char* name, std::size_t length) { return {{name, length}}; }
}   // namespace literals

/// The messages of one file of templates/words.
class Words {
public:
    /// @param file  without folder and ending: "q5"
    explicit constexpr Words(std::string_view file) : file_(file) {}

    /// Returns the message of this key, of one paragraph at most, as running text with its facts filled in and its markup as runs.
    /// @throws std::logic_error for an unknown key, a fact that is not given, or a message of several paragraphs
    Text say(std::string_view key, const Facts& facts) const;
    /// Returns say(key, facts) with the facts given one by one: words.say("limit.spot", "mesh"_a = name, "vertices"_a = 3).
    Text say(std::string_view key, auto... facts) const { return say(key, Facts{std::move(facts)...}); }
    /// Returns the message of this key as plain text with its facts filled in, markup as it is written: for captions, titles, labels, names
    /// of checks.
    /// @throws UsageError if it has a reference [[…]]; std::logic_error like say()
    std::string line(std::string_view key, const Facts& facts) const;
    std::string line(std::string_view key, auto... facts) const { return line(key, Facts{std::move(facts)...}); }
    /// Returns the paragraphs, headings, formulas and lists of the message of this key, in their order; empty paragraphs are left out.
    std::vector<Block> blocks(std::string_view key, const Facts& facts) const;

private:
    std::string_view file_;
};

/// Replaces the bundled messages by the messages in the files "words/…" of these templates. Not thread-safe.
/// @throws UsageError with file and line for an unknown message, or one with a fact that the bundled message lacks
void use_words_of(const Templates& templates);

/// Returns the names and SHA-256 of the files that use_words_of() found changed; empty if none is.
std::string words_identity();

/// Returns a list of all messages for people: one line each, with the names of its facts.
std::string words_documentation();

/// One message of a file.
struct Message {
    std::string key;                       // "limit.spot"
    std::vector<std::string> paragraphs;   // lines joined; each item of a list and each formula is one
    long line = 0;
};
/// Returns the messages of a file in their order.
/// @throws UsageError with file and line if the text begins outside a message
std::vector<Message> messages_of(std::string_view text, const std::string& file);
/// Returns one paragraph of a message as running text, with facts in place of {{…}} and markup as runs.
/// @throws std::logic_error if a fact is missing, or a mark is not closed
Text running_text(std::string_view paragraph, const Facts& facts);
/// Returns one paragraph of a message as plain text, with facts in place of {{…}}; markup stays as it is written.
std::string running_line(std::string_view paragraph, const Facts& facts);
/// Returns a message as headings, formulas, lists and paragraphs in their order, with facts in place of {{…}}.
std::vector<Block> blocks_of(const Message& message, const Facts& facts);
/// Returns a text of the user's as paragraphs and lists. It is Markdown as above: headings become strong paragraphs, "* " begins an item
/// and "1. " a paragraph, $$…$$ is mathematics, and [[q5]] refers to a question. There are no facts.
/// @throws std::logic_error for a mark that is not closed, a fact, or a reference to anything but a question
std::vector<Block> own_blocks(std::string_view text);
/// Returns the names of facts and sections of a message, each once, sorted.
std::vector<std::string> facts_in(const Message& message);

}   // namespace meshfolio::report
